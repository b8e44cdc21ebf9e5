// Manifest, maps and module from the folder; shaders of its own around the module.
#include "tests/methods/bare_renderer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <nlohmann/json.hpp>

#include "renderer/gl/objects.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/pipeline/view.hpp"
#include "tests/support/ktx2_reader.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* vertex_text = R"(
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv;
uniform mat4 world_to_clip;
layout(location = 0) out vec3 at;
layout(location = 1) out vec3 up;
layout(location = 2) out vec4 along;
layout(location = 3) out vec2 uv;
void main() {
  at = in_position;
  up = in_normal;
  along = in_tangent;
  uv = in_uv;
  gl_Position = world_to_clip * vec4(in_position, 1.0);
}
)";

constexpr const char* main_text = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 up;
layout(location = 2) in vec4 along;
layout(location = 3) in vec2 uv;
uniform vec3 eye;
uniform vec3 lamp;
uniform vec3 candela;
uniform vec3 albedo;
uniform vec3 f0;
uniform mat3 world_to_camera;
layout(location = 0) out vec4 seen;
void main() {
  vec3 z = normalize(up);
  vec3 x = normalize(along.xyz - z * dot(z, along.xyz));
  mat3 to_world = mat3(x, along.w * cross(z, x), z);
  vec3 towards_lamp = lamp - at;
  vec3 wi = transpose(to_world) * normalize(towards_lamp);
  vec3 wo = transpose(to_world) * normalize(eye - at);
  Footprints f = footprintsAt(uv);
#ifdef LOOKS_AROUND
  lookAround(at, eye, to_world, world_to_camera, f);
  vec3 reflected = reflectedTowards(effective(f), Surface(albedo, f0), wi, wo, vec4(lamp, 1.0));
#else
  vec3 reflected = reflectedTowards(effective(f), Surface(albedo, f0), wi, wo);
#endif
  seen = vec4(reflected * candela / dot(towards_lamp, towards_lamp), 1.0);
}
)";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream.good()) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA};

// Every number as a 32-bit float, from any format.
gl::Texture texture_from_exr(const Json& texture, const fs::path& folder) {
  constexpr std::array<GLenum, 4> internal{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
  const int layers = texture["layers"];
  const std::size_t c = texture["channels"].get<std::size_t>() - 1;
  std::vector<ExrChain> chains;
  for (const std::string file : texture["exr"]) chains.push_back(read_exr_chain(folder / file));
  const auto& finest = chains.front().levels;
  gl::Texture out(internal.at(c), finest[0].width, finest[0].height, static_cast<int>(finest.size()), layers);
  for (std::size_t level = 0; level < finest.size(); ++level) {
    std::vector<float> texels;
    for (const ExrChain& chain : chains)
      texels.insert(texels.end(), chain.levels[level].texels.begin(), chain.levels[level].texels.end());
    out.upload(static_cast<int>(level), finest[level].width, finest[level].height, formats.at(c), GL_FLOAT,
               texels.data());
  }
  return out;
}

// The texture as Vulkan would take it: the format by its number, the bytes as they are.
gl::Texture texture_from_ktx2(const Json& texture, const fs::path& folder) {
  const std::string bytes = text_of(folder / texture["ktx2"].get<std::string>());
  const test::Ktx2File file = test::read_ktx2({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  struct Format {
    std::uint32_t vulkan;
    GLenum internal, type;
    std::size_t channels;
  };
  constexpr std::array<Format, 12> known{{{100, GL_R32F, GL_FLOAT, 1},
                                          {103, GL_RG32F, GL_FLOAT, 2},
                                          {106, GL_RGB32F, GL_FLOAT, 3},
                                          {109, GL_RGBA32F, GL_FLOAT, 4},
                                          {76, GL_R16F, GL_HALF_FLOAT, 1},
                                          {83, GL_RG16F, GL_HALF_FLOAT, 2},
                                          {90, GL_RGB16F, GL_HALF_FLOAT, 3},
                                          {97, GL_RGBA16F, GL_HALF_FLOAT, 4},
                                          {9, GL_R8, GL_UNSIGNED_BYTE, 1},
                                          {16, GL_RG8, GL_UNSIGNED_BYTE, 2},
                                          {23, GL_RGB8, GL_UNSIGNED_BYTE, 3},
                                          {37, GL_RGBA8, GL_UNSIGNED_BYTE, 4}}};
  constexpr std::array<std::pair<std::uint32_t, GLenum>, 3> blocks{
      {{131, 0x83F0}, {139, GL_COMPRESSED_RED_RGTC1}, {141, GL_COMPRESSED_RG_RGTC2}}};
  for (const auto& [vulkan, internal] : blocks) {
    if (vulkan != file.vk_format) continue;
    gl::Texture out(internal, static_cast<int>(file.width), static_cast<int>(file.height),
                    static_cast<int>(file.levels.size()));
    for (std::size_t level = 0; level < file.levels.size(); ++level)
      out.upload_blocks(static_cast<int>(level), static_cast<int>(file.levels[level].width),
                        static_cast<int>(file.levels[level].height), internal, file.levels[level].bytes);
    return out;
  }
  const auto* format = std::ranges::find(known, file.vk_format, &Format::vulkan);
  gl::Texture out(format->internal, static_cast<int>(file.width), static_cast<int>(file.height),
                  static_cast<int>(file.levels.size()), static_cast<int>(file.layers));
  for (std::size_t level = 0; level < file.levels.size(); ++level) {
    const test::Ktx2Level& texels = file.levels[level];
    out.upload(static_cast<int>(level), static_cast<int>(texels.width), static_cast<int>(texels.height),
               formats.at(format->channels - 1), format->type, texels.bytes.data());
  }
  return out;
}

GLenum wrap_of(const Json& word) {
  if (word == "repeat") return GL_REPEAT;
  return word == "mirrored_repeat" ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
}

gl::Sampler sampler_of(const Json& texture) {
  const Json& wrap = texture["coordinates"]["wrap"];
  return texture["filter"] == "nearest" ? gl::nearest_sampler(wrap_of(wrap[0]), wrap_of(wrap[1]))
                                        : gl::trilinear_sampler(wrap_of(wrap[0]), wrap_of(wrap[1]));
}

// Translations have the uniforms in a structure.
GLint place_of(const gl::Program& program, const std::string& name) {
  const GLint place = program.uniform(name.c_str());
  return place < 0 ? program.uniform(("uniforms." + name).c_str()) : place;
}

void set_uniform(const gl::Program& program, const std::string& name, const Json& value) {
  const GLint place = place_of(program, name);
  if (place < 0) return;  // the module has no use for it
  if (value.is_number_integer()) return gl::api().ProgramUniform1i(program.name(), place, value.get<int>());
  if (!value.is_array()) return gl::api().ProgramUniform1f(program.name(), place, value.get<float>());
  const auto v = value.get<std::vector<float>>();
  if (v.size() == 4) gl::api().ProgramUniform4f(program.name(), place, v[0], v[1], v[2], v[3]);
  if (v.size() == 3) gl::api().ProgramUniform3f(program.name(), place, v[0], v[1], v[2]);
  if (v.size() == 2) gl::api().ProgramUniform2f(program.name(), place, v[0], v[1]);
}

// HLSL has texture and sampler apart. The way back to GLSL joins each pair that is used, under a name of both.
void set_texture(const gl::Program& program, const std::string& name, GLuint unit) {
  for (const auto& [uniform, _] : program.uniforms()) {
    if (uniform != name && !uniform.starts_with("SPIRV_Cross_Combined" + name)) continue;
    gl::api().ProgramUniform1i(program.name(), program.uniform(uniform.c_str()), static_cast<GLint>(unit));
  }
}

gl::Program program_of(const std::string& module, const std::string& shader) {
  if (shader.empty()) {
    const std::string looks_around = module.find("lookAround") == std::string::npos ? "" : "#define LOOKS_AROUND\n";
    return {"bare", std::string("#version 450 core") + vertex_text,
            "#version 450 core\n" + looks_around + module + main_text};
  }
  return {"translated", shader.substr(0, shader.find('\n')) + vertex_text, shader};
}

// Rows from the top.
Image upright(const Image& picture) {
  Image out(picture.width, picture.height, picture.channels);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) std::ranges::copy(picture.at(x, picture.height - 1 - y), out.at(x, y).begin());
  }
  return out;
}

struct Triangles {
  explicit Triangles(const Mesh& mesh)
      : vertices(std::as_bytes(std::span(mesh.vertices))), indices(std::as_bytes(std::span(mesh.indices))) {
    const GLuint name = array.name();
    gl::api().VertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(Vertex));
    gl::api().VertexArrayElementBuffer(name, indices.name());
    constexpr std::array<std::pair<GLint, std::size_t>, 4> members{{{3, offsetof(Vertex, position)},
                                                                    {3, offsetof(Vertex, normal)},
                                                                    {4, offsetof(Vertex, tangent)},
                                                                    {2, offsetof(Vertex, uv0)}}};
    for (GLuint i = 0; i < members.size(); ++i) {
      gl::api().EnableVertexArrayAttrib(name, i);
      gl::api().VertexArrayAttribFormat(name, i, members.at(i).first, GL_FLOAT, GL_FALSE,
                                        static_cast<GLuint>(members.at(i).second));
      gl::api().VertexArrayAttribBinding(name, i, 0);
    }
  }

  gl::Buffer vertices, indices;
  gl::VertexArray array = gl::VertexArray::make();
};

}  // namespace

Scene rough_square(int texels) {
  Scene scene = receding_grooves();
  Material& material = scene.materials.front();
  material.normal_map->image = std::make_shared<const Image>(random_normals(texels, texels, 0.5F, 3));
  Image rough(16, 16, 2, 0.0F);
  for (std::size_t i = 0; i < rough.texel_count(); ++i) rough.texels[2 * i] = 0.3F + 0.02F * static_cast<float>(i % 16);
  material.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(rough), {}};
  return scene;
}

Image render_from_files(const fs::path& folder, const Scene& scene, const glm::ivec2& size, MapFiles maps,
                        const std::string& shader) {
  const gl::Context& context = shared_context();
  const Json manifest = Json::parse(text_of(folder / "manifest.json"));
  const Json& material = manifest["materials"][0];
  const std::string module = text_of(folder / manifest["module"].get<std::string>());
  const gl::Program program = program_of(module, shader);
  std::vector<gl::Texture> textures;
  std::vector<gl::Sampler> samplers;
  for (const Json& texture : material["textures"]) {
    const auto unit = static_cast<GLuint>(textures.size());
    textures.push_back(maps == MapFiles::exr ? texture_from_exr(texture, folder) : texture_from_ktx2(texture, folder));
    samplers.push_back(sampler_of(texture));
    gl::api().BindTextureUnit(unit, textures.back().name());
    gl::api().BindSampler(unit, samplers.back().name());
    set_texture(program, texture["name"], unit);
  }
  for (const auto& [name, value] : material["uniforms"].items()) set_uniform(program, name, value);

  const std::string footprint = manifest["footprint"];
  set_uniform(program, "footprint_parts", std::stoi(footprint.substr(footprint.find(':') + 1)));

  const Json& surface = material["surface"];
  const auto base = surface["base_color"].get<std::vector<float>>();
  const auto dielectric = surface["dielectric_specular"].get<std::vector<float>>();
  const float metallic = surface["metallic"];
  Json albedo = Json::array(), f0 = Json::array();
  for (std::size_t c = 0; c < 3; ++c) {
    albedo.push_back(base[c] * (1.0F - metallic));
    f0.push_back(std::lerp(dielectric[c], base[c], metallic));
  }
  const auto& lamp = std::get<PointLight>(scene.lights.front());
  const glm::vec3 eye = camera_position(scene.camera);
  set_uniform(program, "albedo", albedo);
  set_uniform(program, "f0", f0);
  set_uniform(program, "eye", {eye.x, eye.y, eye.z});
  set_uniform(program, "lamp", {lamp.position.x, lamp.position.y, lamp.position.z});
  set_uniform(program, "candela", {lamp.intensity.x, lamp.intensity.y, lamp.intensity.z});
  const glm::mat4 world_to_clip =
      tile_matrix({.size = size, .camera = scene.camera}, {.origin = {0, 0}, .size = size}, {0.0, 0.0});
  gl::api().ProgramUniformMatrix4fv(program.name(), place_of(program, "world_to_clip"), 1, GL_FALSE,
                                    glm::value_ptr(world_to_clip));

  if (const GLint place = place_of(program, "world_to_camera"); place >= 0) {
    const glm::mat3 turn = footprint::world_to_camera(scene.camera);
    gl::api().ProgramUniformMatrix3fv(program.name(), place, 1, GL_FALSE, glm::value_ptr(turn));
  }
  const gl::RenderTarget target(size.x, size.y, std::array<GLenum, 1>{GL_RGBA32F}, true);
  const Triangles triangles(scene.meshes.front());
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl::api().Viewport(0, 0, size.x, size.y);
  gl::api().ClearColor(0, 0, 0, 0);
  gl::api().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl::api().Disable(GL_CULL_FACE);
  gl::api().Disable(GL_BLEND);
  gl::api().Disable(GL_DEPTH_TEST);
  gl::api().UseProgram(program.name());
  gl::api().BindVertexArray(triangles.array.name());
  gl::api().DrawElements(GL_TRIANGLES, static_cast<GLsizei>(scene.meshes.front().indices.size()), GL_UNSIGNED_INT,
                         nullptr);
  Image picture(size.x, size.y, 4);
  target.read(0, 4, picture.texels);
  context.check("drawing from files");
  return upright(picture);
}

}  // namespace footprint::testing
