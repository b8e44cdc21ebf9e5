// Checks and interpolates sweeps of parameters, and makes one edit after the other: geometry, bake, upload and frame,
// each timed.
#include "experiments/studies/edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <utility>

#include "experiments/studies/exposure.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/report_facts.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/core/names.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/assembly/microgeometry_content.hpp"

namespace footprint {
namespace {

constexpr const char* brdf_kind = "brdf";  // of a sweep over the base BRDF
// Its values are MERL files; between them it is the share of the second, 0 to 1.
constexpr const char* measured_parameter = "measured";

const std::vector<OptionSpec>& brdf_parameters() {
  static const std::vector<OptionSpec> parameters{
      number_option("roughness", 0.5, 0.0, 1.0, "perceptual roughness; alpha is its square"),
      number_option("exponent", 64.0, 1e-3, 1e6, "exponent of blinn_phong"),
      number_option("alpha", 0.25, smallest_alpha, 1.0, "alpha of beckmann and ggx"),
      number_option("kappa", 64.0, 1e-3, 1e6, "concentration of vmf"),
      number_option("specular", 0.04, 0.0, 1.0, "reflectance of dielectrics at normal incidence, all channels"),
      number_option("metallic", 0.0, 0.0, 1.0, "metalness"),
      number_option(measured_parameter, 0.0, 0.0, 1.0, "share of the second of two MERL files")};
  return parameters;
}

const std::vector<OptionSpec>& parameters_of(const std::string& kind) {
  return kind == brdf_kind ? brdf_parameters() : find_patch_kind(kind).parameters;
}

const OptionSpec& spec_of(const std::string& kind, const std::string& parameter, const std::string& place) {
  std::vector<std::string> names;
  for (const OptionSpec& spec : parameters_of(kind)) {
    if (spec.name == parameter) return spec;
    names.push_back(spec.name);
  }
  throw Error(ErrorKind::usage, place, fmt::format("{} has no parameter `{:.80}`", kind, parameter),
              names.empty() ? "it has none" : suggestion(parameter, names));
}

bool is_measured(const ParameterSweep& sweep) {
  return sweep.kind == brdf_kind && sweep.parameter == measured_parameter;
}

bool is_word(const OptionSpec& spec) { return !spec.choices.empty(); }

template <class Work>
double time_work(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The kind of small-scale geometry that changes; `brdf` if none does.
std::string edited_kind(std::span<const ParameterSweep> sweeps) {
  for (const ParameterSweep& sweep : sweeps) {
    if (sweep.kind != brdf_kind) return sweep.kind;
  }
  return brdf_kind;
}

std::optional<MeasuredPair> measured_pair(std::span<const ParameterSweep> sweeps) {
  const auto found = std::ranges::find_if(sweeps, is_measured);
  if (found == sweeps.end()) return {};
  return MeasuredPair{read_merl(found->from), read_merl(found->to)};
}

// The parts whose patch the sweeps change; the others stay as they are.
SceneSource editable_source(const EditSettings& settings) {
  SceneSource source = read_scene(settings.run.scene, settings.run.scene_library, settings.run.overrides);
  const std::string edited = edited_kind(settings.sweeps);
  const PatchKind* kind = nullptr;
  for (const PartSettings& part : source.settings.parts) {
    for (const MicrogeometrySettings& patch : part.microgeometry) {
      const bool wanted = kind != nullptr && kind->name == edited;
      if (patch.kind != nullptr && !wanted) kind = patch.kind;
    }
  }
  if (kind == nullptr && edited != brdf_kind) {
    throw Error(ErrorKind::usage, settings.run.scene, "has no generated small-scale geometry to edit",
                "take a scene with [microgeometry] and a kind in its scene.toml, or set brdf.PARAMETER");
  }
  check_sweeps(settings.sweeps, kind);
  return source;
}

// The scene's colours before any patch has its share in them.
std::vector<glm::vec4> own_colors(SceneSource source) {
  MicrogeometrySettings white;
  white.kind = &find_patch_kind("flat");
  for (PartSettings& part : source.settings.parts) {
    for (MicrogeometrySettings& patch : part.microgeometry) patch = white;
  }
  std::vector<glm::vec4> colors;
  for (const Material& material : assemble(source).materials) colors.push_back(material.base_color);
  return colors;
}

// A patch of the settings and the materials that have it.
struct EditedPatch {
  std::size_t part, index;  // in the part
  std::vector<std::size_t> materials;
};

// In a scene, parts follow each other, and the materials of one part share its patches, which come in turn.
std::vector<EditedPatch> patches_of(const SceneSettings& settings, const Scene& scene) {
  std::vector<EditedPatch> out;
  std::size_t material = 0;
  const auto patch_of = [&](std::size_t i) { return scene.materials[i].microgeometry; };
  for (std::size_t part = 0; part < settings.parts.size(); ++part) {
    const std::size_t count = settings.parts[part].microgeometry.size();
    if (count == 0) continue;
    while (material < scene.materials.size() && !patch_of(material)) ++material;
    const std::size_t first = material, own = out.size();
    for (std::size_t index = 0; index < count; ++index) out.push_back({part, index, {}});
    for (; material < scene.materials.size() && patch_of(material); ++material) {
      const std::size_t index = (material - first) % count;
      if (material >= first + count && patch_of(material) != patch_of(first + index)) break;  // the next part's
      out[own + index].materials.push_back(material);
    }
  }
  return out;
}

// A method with its program on the GPU, for a set of effects. Pinned: each part keeps the address of those before it.
struct EditedDrawing {
  EditedDrawing(const gl::Context& context, const Scene& scene, const EffectSet& wanted, BakedMethod first,
                const glm::ivec2& size, const FootprintFilter& filter, int tile)
      : effects(wanted),
        gpu_scene(context.info(), scene, effects),
        baked(std::make_unique<BakedMethod>(std::move(first))),
        method(std::make_unique<GpuMethod>(gpu_scene, *baked)),
        frames(context.info(), gpu_scene, *method, size, frame_program(scene, filter), tile) {}

  // Takes over what an edit changed. Waits until the GPU has it.
  void exchange(const Scene& scene, BakedMethod next) {
    auto next_baked = std::make_unique<BakedMethod>(std::move(next));
    auto next_method = std::make_unique<GpuMethod>(gpu_scene, *next_baked);
    gpu_scene.update(scene);
    frames.exchange(*next_method);
    method = std::move(next_method);
    baked = std::move(next_baked);
    gl::api().Finish();
  }

  EffectSet effects;
  GpuScene gpu_scene;
  std::unique_ptr<BakedMethod> baked;
  std::unique_ptr<GpuMethod> method;
  FrameRenderer frames;
};

class Editor {
 public:
  Editor(const EditSettings& settings, RunFolder folder, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        source_(editable_source(settings)),
        edited_(edited_kind(settings.sweeps)),
        tables_(measured_pair(settings.sweeps)),
        own_colors_(own_colors(source_)),
        scene_(assemble(source_)),
        patches_(patches_of(source_.settings, scene_)),
        size_(frame_size(scene_, settings.run.view.size)),
        context_(settings.run.backend.context),
        parts_(progress, settings.frames) {
    require_pictures(size_, pictures_of_a_frame);
  }

  EditRun run() {
    std::filesystem::create_directories(folder_ / "images");
    for (int frame = 0; frame < settings_.frames; ++frame) add_frame(frame);
    run_.backend = backend_info(context_.info());
    run_.scene = scene_info(scene_, exposure_);
    run_.kind = edited_;
    run_.method = method().text;
    run_.size = {size_.x, size_.y};
    return std::move(run_);
  }

 private:
  [[nodiscard]] const MethodSpec& method() const { return settings_.run.methods.front(); }

  void add_frame(int frame) {
    const Progress progress = parts_.next(1, fmt::format("frame {} of {}: ", frame + 1, settings_.frames));
    EditRecord record{
        .frame = frame, .parameters = values_at(settings_.sweeps, edited_, frame, settings_.frames), .bytes = 0};
    progress("geometry", 0.0);
    if (edited_ != brdf_kind)
      record.stages.push_back({"geometry", time_work([&] { change_geometry(record.parameters); })});
    const auto brdf = values_at(settings_.sweeps, brdf_kind, frame, settings_.frames);
    if (!brdf.empty())
      record.stages.push_back({"BRDF", time_work([&] { set_brdf(brdf, tables_ ? &*tables_ : nullptr, scene_); })});
    record.parameters.insert(brdf.begin(), brdf.end());
    const EffectSet effects = effects_on(derive_effects(scene_));
    if (!drawing_) scene_ = refined_for_visibility(std::move(scene_), effects);
    BakedMethod baked = timed_bake(effects, record.stages, progress);
    record.bytes = baked.bytes;
    for (const Prefiltered& material : baked.materials) {
      record.notes.insert(record.notes.end(), material.notes.begin(), material.notes.end());
    }
    const View view{.size = size_, .camera = camera_at_distance(scene_, 1.0)};
    show(std::move(baked), effects, view, record.stages);
    write(view, record);
    run_.records.push_back(std::move(record));
  }

  void change_geometry(const std::map<std::string, std::string>& parameters) {
    for (const EditedPatch& patch : patches_) {
      MicrogeometrySettings& geometry = source_.settings.parts[patch.part].microgeometry[patch.index];
      if (geometry.kind == nullptr || geometry.kind->name != edited_) continue;
      for (const auto& [name, value] : parameters) geometry.parameters[name] = value;
      const MicrogeometryContent content = load_microgeometry(geometry);
      for (const std::size_t i : patch.materials) {
        scene_.materials[i].base_color = own_colors_[i];
        apply(content, scene_.materials[i]);
      }
    }
  }

  // The method's own stages by name, and `other` for what of the bake is none of them.
  BakedMethod timed_bake(const EffectSet& effects, std::vector<StageTime>& stages, const Progress& progress) const {
    StageClock clock;
    const Progress report = clock.callback(progress);
    BakedMethod baked = edited_ == brdf_kind && drawing_ && drawing_->effects == effects
                            ? bake_after_brdf(*drawing_->baked, scene_, effects, report)
                            : bake(find_method(method()), method(), scene_, effects, report);
    clock.stop();
    double other = baked.seconds;
    for (const StageTime& time : clock.times()) {
      if (time.stage.starts_with(method().text + ": ")) continue;  // what bake itself reports of each material
      stages.push_back(time);
      other -= time.seconds;
    }
    stages.push_back({"other", std::max(other, 0.0)});
    return baked;
  }

  void show(BakedMethod baked, const EffectSet& effects, const View& view, std::vector<StageTime>& stages) {
    if (!drawing_ || drawing_->effects != effects) {
      BakedMethod first = baked;
      drawing_.reset();
      drawing_ = std::make_unique<EditedDrawing>(context_, scene_, effects, std::move(first), size_,
                                                 footprint_filter_of(settings_.run.footprint, scene_),
                                                 settings_.run.backend.tile);
      drawing_->frames.draw(view);
      gl::api().Finish();
    }
    stages.push_back({"upload", time_work([&] { drawing_->exchange(scene_, std::move(baked)); })});
    stages.push_back({"frame", time_work([&] {
                        drawing_->frames.draw(view);
                        gl::api().Finish();
                      })});
    context_.check("rendering " + method().text);
  }

  void write(const View& view, EditRecord& record) {
    const Image picture = drawing_->frames.render(view);
    if (record.frame == 0) exposure_ = choose_exposure(settings_.run.view.exposure, scene_, picture);
    record.image = write_picture(folder_, fmt::format("{}_{:04}", method_stem(settings_.run.methods, 0), record.frame),
                                 picture, exposure_.factor);
  }

  const EditSettings& settings_;
  RunFolder folder_;
  SceneSource source_;
  std::string edited_;
  std::optional<MeasuredPair> tables_;
  std::vector<glm::vec4> own_colors_;
  Scene scene_;
  std::vector<EditedPatch> patches_;
  glm::ivec2 size_;
  gl::Context context_;
  ProgressParts parts_;
  std::unique_ptr<EditedDrawing> drawing_;
  Exposure exposure_;
  EditRun run_;
};

void require(bool has, const Material& material, const std::string& parameter, const char* why) {
  if (has) return;
  throw Error(ErrorKind::usage, fmt::format("--set brdf.{}", parameter),
              fmt::format("material {} {}", material.name, why),
              "set a parameter that its base BRDF has (docs/explanation/base-brdf.md)");
}

void set_width(const std::string& parameter, float value, Material& material) {
  require(material.lobes.empty(), material, parameter, "has lobes of its own");
  require(width_map(material) == nullptr && !material.lobe_parameter_map, material, parameter,
          "has its width from a map");
  if (parameter == "roughness") {
    material.roughness = value;
    material.lobe_parameter.reset();
    return;
  }
  const NormalDistribution own = material.brdf.distribution;
  const std::string_view its_parameter = own == NormalDistribution::blinn_phong ? "exponent"
                                         : own == NormalDistribution::vmf       ? "kappa"
                                                                                : "alpha";
  require(parameter == its_parameter, material, parameter, "has another distribution");
  material.lobe_parameter = value;
}

std::shared_ptr<const Microgeometry> with_table(const Microgeometry& patch, const MeasuredPair& tables, float share) {
  TabulatedBrdf mixed = tables.from;
  for (std::size_t i = 0; i < mixed.values.size(); ++i)
    mixed.values[i] = glm::mix(tables.from.values[i], tables.to.values[i], share);
  Microgeometry changed = patch;
  changed.brdf = std::make_shared<const TabulatedBrdf>(std::move(mixed));
  return std::make_shared<const Microgeometry>(std::move(changed));
}

void set(const std::string& parameter, float value, const MeasuredPair* tables, Material& material) {
  if (parameter == measured_parameter) {
    require(material.microgeometry != nullptr, material, parameter, "has no small-scale geometry");
    material.microgeometry = with_table(*material.microgeometry, *tables, value);
  } else if (parameter == "specular") {
    material.dielectric_specular = glm::vec3(value);
  } else if (parameter == "metallic") {
    require(metallic_map(material) == nullptr, material, parameter, "has its metalness from a map");
    material.metallic = value;
  } else {
    set_width(parameter, value, material);
  }
}

}  // namespace

void set_brdf(const std::map<std::string, std::string>& values, const MeasuredPair* tables, Scene& scene) {
  for (Material& material : scene.materials) {
    for (const auto& [parameter, value] : values) set(parameter, std::stof(value), tables, material);
  }
}

ParameterSweep parse_sweep(const std::string& text) {
  const std::string place = fmt::format("--set {:.200}", text);
  const std::size_t dot = text.find('.'), equals = text.find('=');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals) {
    throw Error(ErrorKind::usage, place, "is not KIND.PARAMETER=FROM:TO", "write --set weave.warp_width=0.1:0.5");
  }
  ParameterSweep sweep{text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), {}, {}};
  const std::string values = text.substr(equals + 1);
  const std::size_t colon = values.find(':');
  sweep.from = values.substr(0, colon);
  sweep.to = colon == std::string::npos ? sweep.from : values.substr(colon + 1);
  try {
    const OptionSpec& spec = spec_of(sweep.kind, sweep.parameter, "");
    if (is_measured(sweep)) return sweep;
    for (const std::string& value : {sweep.from, sweep.to}) {
      const Options checked(parameters_of(sweep.kind), {{sweep.parameter, value}}, sweep.kind);
    }
    if (is_word(spec) && sweep.from != sweep.to) {
      throw Error(ErrorKind::usage, "", "a word has nothing between its first value and its last", "give one of them");
    }
  } catch (const Error& error) {
    throw error.within(place);
  }
  return sweep;
}

void check_sweeps(std::span<const ParameterSweep> sweeps, const PatchKind* kind) {
  for (const ParameterSweep& sweep : sweeps) {
    const std::string name = sweep.kind + "." + sweep.parameter;
    if (sweep.kind != brdf_kind && (kind == nullptr || sweep.kind != kind->name)) {
      const std::string own = kind == nullptr ? "none" : kind->name;
      throw Error(ErrorKind::usage, "--set " + name, fmt::format("the scene's small-scale geometry is {}", own),
                  fmt::format("set a parameter of {}", kind == nullptr ? brdf_kind : own));
    }
    if (std::ranges::count(sweeps, sweep.parameter, &ParameterSweep::parameter) > 1) {
      throw Error(ErrorKind::usage, "--set " + name, "is given twice", "give it once, as FROM:TO");
    }
  }
}

std::map<std::string, std::string> values_at(std::span<const ParameterSweep> sweeps, const std::string& kind, int frame,
                                             int frames) {
  std::map<std::string, std::string> values;
  const double part = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0;
  for (const ParameterSweep& sweep : sweeps) {
    if (sweep.kind != kind) continue;
    const OptionSpec& spec = spec_of(sweep.kind, sweep.parameter, "--set");
    if (!is_measured(sweep) && (is_word(spec) || sweep.from == sweep.to)) {
      values[sweep.parameter] = sweep.from;
      continue;
    }
    const double value = is_measured(sweep) ? part : std::lerp(std::stod(sweep.from), std::stod(sweep.to), part);
    values[sweep.parameter] = fmt::format("{}", spec.integer ? std::round(value) : value);
  }
  return values;
}

EditRun run_edit(const EditSettings& settings, const RunFolder& folder, const Progress& progress) {
  return Editor(settings, folder, progress).run();
}

}  // namespace footprint
