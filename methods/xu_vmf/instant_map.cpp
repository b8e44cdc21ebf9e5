// Compiles the passes of the build and runs them over the levels and layers of the map.
#include "methods/xu_vmf/instant_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/pipeline/shader_source.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

extern const EmbeddedTexts xu_vmf_glsl;

namespace xu_vmf {
namespace {

constexpr std::array<float, 4> nothing{};

gl::Framebuffer framebuffer(GLuint attachments) {
  gl::Framebuffer made = gl::Framebuffer::make();
  std::vector<GLenum> buffers;
  for (GLuint i = 0; i < attachments; ++i) buffers.push_back(GL_COLOR_ATTACHMENT0 + i);
  gl::api().NamedFramebufferDrawBuffers(made.name(), static_cast<GLsizei>(attachments), buffers.data());
  return made;
}

// A texture of the job by its name; null if the precompute made none.
const GpuTexture* texture_of(const FrameBuildJob& job, std::string_view name) {
  const auto& baked = job.baked.textures;
  const auto found = std::ranges::find(baked, name, &PrefilteredTexture::name);
  return found == baked.end() ? nullptr : &job.textures[static_cast<std::size_t>(found - baked.begin())];
}

bool in_camera_space(const FrameBuildJob& job) {
  const auto found = job.baked.scalars.find(std::string(camera_space_name));
  return found != job.baked.scalars.end() && found->second > 0.5F;
}

void show_levels(const gl::Texture& map, int first, int last) {
  gl::api().TextureParameteri(map.name(), GL_TEXTURE_BASE_LEVEL, first);
  gl::api().TextureParameteri(map.name(), GL_TEXTURE_MAX_LEVEL, last);
}

// The lookups that average the texels under a texel of the next level (sharesOf in xu_vmf_storing.glsl).
double averaging_lookups(const gl::Texture& map, int level) {
  const glm::ivec2 finer = glm::max(glm::ivec2(map.width(), map.height()) >> level, 1);
  const glm::ivec2 taps = glm::min(finer, 2 + finer % 2);
  return static_cast<double>(taps.x) * taps.y;
}

const PrefilteredTexture& declared(const FrameBuildJob& job, std::string_view name) {
  return *std::ranges::find(job.baked.textures, name, &PrefilteredTexture::name);
}

Conversion conversion_of(const Options& options) {
  const std::string& word = options.word("conversion");
  return word == "table" ? Conversion::table : word == "published" ? Conversion::published : Conversion::newton;
}

}  // namespace

Settings settings_of(const Options& options) {
  const std::string& j = options.word("j");
  return {.adaptive = j == "adaptive",
          .most_lobes = j == "1"   ? 1
                        : j == "4" ? 4
                                   : 8,
          .camera_space = options.word("space") == "camera",
          .conversion = conversion_of(options),
          .joint = options.word("specular") == "joint",
          .always_built = options.word("rebuild") == "always",
          .storage = parse_storage(options.word("storage"))};
}

InstantMap::InstantMap(const ShaderVariant& variant, const Options& options)
    : settings_(settings_of(options)),
      effects_(variant.effects),
      parts_(settings_.part_layers()),
      first_cut_(settings_.adaptive ? 1 : 0),
      guards_(settings_.has_guards(variant.effects)),
      joined_(framebuffer(guards_ ? 2 : 1)) {
  const auto pass = [&](std::string_view file, bool guard, bool camera, std::string_view constants = {}) {
    const ShaderModule module = module_of(xu_vmf_glsl, file, {{"guard", guard}, {"camera", camera}});
    return frame_build_shader(variant, module, options, constants);
  };
  const auto program = [](std::string_view title, const std::string& vertices, const ShaderText& fragments) {
    return gl::Program(fmt::format("{} ({})", title, fragments.lines()), vertices, fragments.text());
  };
  const auto layer_count = [](GLuint layers) { return fmt::format("const int layer_count = {};\n", layers); };
  const auto stage = [&](GLuint layers) {
    return Stage{framebuffer(layers),
                 program("xu_vmf_coarsen", screen_vertex_shader(),
                         pass("xu_vmf_coarsen.glsl", guards_, false, layer_count(layers))),
                 layers, settings_.adaptive ? layers - layers / 3 : layers};
  };
  join_flat_ = program("xu_vmf_join", screen_vertex_shader(), pass("xu_vmf_join.glsl", guards_, false));
  whole_ = stage(1);
  if (parts_ > 0) {
    const GLuint at_once = settings_.adaptive ? 6 : static_cast<GLuint>(parts_);
    const auto split = [&](std::string_view title, bool guard) {
      return program(title, screen_vertex_shader(), pass("xu_vmf_split.glsl", guard, false, layer_count(at_once)));
    };
    split_stage_ = stage(at_once);
    split_.emplace(split("xu_vmf_split", false));
    if (guards_) split_guard_.emplace(split("xu_vmf_split, guard", true));
  }
  if (!settings_.camera_space) return;
  join_surface_.emplace(program("xu_vmf_join, camera space", pass("xu_vmf_raster_vertex.glsl", guards_, true).text(),
                                pass("xu_vmf_join.glsl", guards_, true)));
}

std::optional<BuildInputs> InstantMap::valid_until_change_of() const {
  if (settings_.always_built) return {};
  const bool camera = join_surface_.has_value();
  return BuildInputs{.camera = camera, .geometry = camera, .materials = true, .lights = false};
}

void InstantMap::run(const FrameBuildJob& job) const {
  for (const GLenum off : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND}) gl::api().Disable(off);
  gl::api().BindBufferBase(GL_UNIFORM_BUFFER, block_binding::material, job.batch.material_block.name());
  join(job);
  for (const std::string_view name : {whole_name, whole_guard_name}) coarsen(job, name);
  if (parts_ == 0) return;
  split(job, *split_, whole_name, parts_name);
  if (guards_) split(job, *split_guard_, whole_guard_name, parts_guard_name);
  for (const std::string_view name : {parts_name, parts_guard_name}) coarsen(job, name);
}

void InstantMap::prepare_join(const FrameBuildJob& job, const gl::Program& program, bool camera) const {
  constexpr std::array inputs{normals_name, variances_name, table_name, colours_name};
  for (GLuint unit = 0; unit < inputs.size(); ++unit) {
    if (const GpuTexture* input = texture_of(job, inputs.at(unit)))
      gl::bind_texture(unit, *input->texture, samplers_.sampler(input->coordinates, SamplerState::nearest));
  }
  gl::api().UseProgram(program.name());
  if (!camera) {
    const gl::Texture& map = *texture_of(job, whole_name)->texture;
    gl::api().Uniform2i(program.uniform("map_size"), map.width(), map.height());
    return;
  }
  const Camera& seen_by = job.view.camera;
  const glm::mat3 rotation = world_to_camera(seen_by);
  const glm::vec4 viewer =
      seen_by.orthographic ? glm::vec4(direction_to_camera(seen_by), 0.0F) : glm::vec4(camera_position(seen_by), 1.0F);
  gl::api().UniformMatrix3fv(program.uniform("world_to_camera"), 1, GL_FALSE, glm::value_ptr(rotation));
  gl::api().Uniform4fv(program.uniform("viewer"), 1, glm::value_ptr(viewer));
  gl::api().Uniform1i(program.uniform("two_sided"), job.batch.double_sided ? 1 : 0);
}

void InstantMap::join(const FrameBuildJob& job) const {
  const bool camera = in_camera_space(job);
  const gl::Texture& map = *texture_of(job, whole_name)->texture;
  const gl::Program& program = camera ? *join_surface_ : join_flat_;
  prepare_join(job, program, camera);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, joined_.name());
  gl::api().Viewport(0, 0, map.width(), map.height());
  const int layers = declared(job, whole_name).layers;
  for (int layer = 0; layer < layers; ++layer) {
    gl::api().NamedFramebufferTextureLayer(joined_.name(), GL_COLOR_ATTACHMENT0, map.name(), 0, layer);
    if (guards_) {
      const gl::Texture& guard = *texture_of(job, whole_guard_name)->texture;
      gl::api().NamedFramebufferTextureLayer(joined_.name(), GL_COLOR_ATTACHMENT1, guard.name(), 0, 0);
    }
    const bool normals_alone = layers > 1 && layer == layers - 1;
    if (has(effects_, Effect::multi_lobe)) gl::api().Uniform1i(program.uniform("own_lobe"), normals_alone ? -1 : layer);
    for (GLint i = 0; camera && i < (guards_ ? 2 : 1); ++i) gl::api().ClearBufferfv(GL_COLOR, i, nothing.data());
    draw_recorded(job.record, program, 0, [&] {  // its loops have constant rounds and read nothing
      if (camera) {
        gl::api().BindVertexArray(job.vertex_array);
        gl::api().DrawElements(GL_TRIANGLES, job.batch.index_count, GL_UNSIGNED_INT, nullptr);
      } else {
        triangle_.draw();
      }
    });
  }
}

// Computes level 1 of the parts from the finest level of `from`, a texture of the whole hemisphere.
void InstantMap::split(const FrameBuildJob& job, const gl::Program& program, std::string_view from,
                       std::string_view to) const {
  const gl::Texture& parts = *texture_of(job, to)->texture;
  const int own_lobes = declared(job, to).layers / parts_;
  const glm::ivec2 size(parts.width(), parts.height());
  const double lookups = averaging_lookups(*texture_of(job, from)->texture, 0);
  const int inputs = from == whole_name ? 1 : 2;
  for (int own = 0; own < own_lobes; ++own) {
    if (first_cut_ > 0) {  // the hemisphere itself
      gl::bind_texture(0, *texture_of(job, from)->texture);
      gl::api().UseProgram(whole_.coarsen.name());
      gl::api().Uniform1i(whole_.coarsen.uniform("first_layer"), own);
      draw_into(job, whole_, {whole_.coarsen, lookups, parts, size, own * parts_});
    }
    gl::bind_texture(0, *texture_of(job, whole_name)->texture);
    gl::bind_texture(1, *texture_of(job, from)->texture);
    gl::api().UseProgram(program.name());
    gl::api().Uniform1i(program.uniform("source"), own);
    for (int first = first_cut_; first < parts_; first += static_cast<int>(split_stage_.layers)) {
      gl::api().Uniform1i(program.uniform("first_part"), first);
      draw_into(job, split_stage_, {program, inputs * lookups, parts, size, own * parts_ + first});
    }
  }
}

void InstantMap::draw_into(const FrameBuildJob& job, const Stage& stage, const LevelDraw& draw) const {
  for (GLuint i = 0; i < stage.layers; ++i) {
    gl::api().NamedFramebufferTextureLayer(stage.framebuffer.name(), GL_COLOR_ATTACHMENT0 + i, draw.target.name(), 0,
                                           draw.first_layer + static_cast<GLint>(i));
  }
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, stage.framebuffer.name());
  gl::api().Viewport(0, 0, draw.size.x, draw.size.y);
  draw_recorded(job.record, draw.program, draw.lookups, [&] { triangle_.draw(); });
}

// A texture with room for `layers` of `size` in the format of `like`.
const gl::Texture& InstantMap::room_for(const gl::Texture& like, const glm::ivec2& size, int layers) const {
  GLint format = 0;
  gl::api().GetTextureLevelParameteriv(like.name(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  if (format == drawn_format_ && size.x <= drawn_.width() && size.y <= drawn_.height() && layers <= drawn_layers_)
    return drawn_;
  drawn_ = gl::Texture();  // freed before the next one is allocated
  drawn_ = gl::Texture(static_cast<GLenum>(format), size.x, size.y, 1, layers);
  drawn_format_ = format;
  drawn_layers_ = layers;
  return drawn_;
}

// Fills the coarser levels of a texture, if the job has it, by way of a texture of their own. OpenGL allows drawing
// into a level while another is read (4.5 core, section 9.3.1). But in Vulkan both need different layouts, and a driver
// over it with one layout per texture breaks that rule. Mesa's zink does, as `scripts/validate_vulkan` shows.
void InstantMap::coarsen(const FrameBuildJob& job, std::string_view name) const {
  const GpuTexture* built = texture_of(job, name);
  if (built == nullptr) return;
  const bool of_parts = name == parts_name || name == parts_guard_name;
  const int levels = static_cast<int>(declared(job, name).levels.size());
  const int layers = declared(job, name).layers;
  gl::bind_texture(0, *built->texture);
  for (int level = 1; level < levels; ++level) {
    show_levels(*built->texture, level - 1, level - 1);  // the one that this level is computed from
    const double taps = averaging_lookups(*built->texture, level - 1);
    const glm::ivec2 size = glm::max(glm::ivec2(built->texture->width(), built->texture->height()) >> level, 1);
    for (int first = 0; first < layers;) {
      const Stage& stage = of_parts && first % parts_ >= first_cut_ ? split_stage_ : whole_;
      gl::api().UseProgram(stage.coarsen.name());
      gl::api().Uniform1i(stage.coarsen.uniform("first_layer"), first);
      const int drawn = static_cast<int>(stage.layers);
      const gl::Texture& target = room_for(*built->texture, size, drawn);
      draw_into(job, stage, {stage.coarsen, stage.averaged * taps, target, size, 0});
      gl::api().CopyImageSubData(target.name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, built->texture->name(),
                                 GL_TEXTURE_2D_ARRAY, level, 0, 0, first, size.x, size.y, drawn);
      record_copy(job.record, target, static_cast<double>(size.x) * size.y * drawn);
      first += drawn;
    }
  }
  show_levels(*built->texture, 0, levels - 1);
}

}  // namespace xu_vmf
}  // namespace footprint
