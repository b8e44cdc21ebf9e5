// Models and frames that are odd but valid: they render, and a message names the fix.
#include <limits>

#include "tests/command_line/bumpy_quad.hpp"
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// The bumpy quad with one attribute or with the indices replaced, and what the program says of it.
Case with_attribute(const std::string& name, const std::string& attribute, const std::vector<float>& values,
                    const std::vector<std::string>& says = {}) {
  GltfBuilder quad = make_bumpy_quad();
  const std::string type = attribute == "TEXCOORD_0" ? "VEC2" : "VEC3";
  primitive_of(quad)["attributes"][attribute] = quad.add_floats(values, type);
  return {.name = name,
          .arguments = {"{}/quad.gltf"},
          .says = says,
          .files = {{"quad.gltf", quad.text()}, {"bumps.png", bumps_png()}}};
}

Case with_indices(const std::string& name, const std::vector<std::uint16_t>& indices) {
  GltfBuilder quad = make_bumpy_quad();
  primitive_of(quad)["indices"] = quad.add_indices(indices);
  return {
      .name = name, .arguments = {"{}/quad.gltf"}, .files = {{"quad.gltf", quad.text()}, {"bumps.png", bumps_png()}}};
}

Case without_normals() {
  GltfBuilder quad = make_bumpy_quad();
  primitive_of(quad)["attributes"].erase("NORMAL");
  return {.name = "NoNormals",
          .arguments = {"{}/quad.gltf"},
          .files = {{"quad.gltf", quad.text()}, {"bumps.png", bumps_png()}}};
}

std::vector<Case> models() {
  const std::vector<float> one_place(12, 0.5F);
  return {
      with_attribute("NormalsOfLengthZero", "NORMAL", std::vector<float>(12, 0.0F),
                     {"mesh 0", "4 normals without a direction"}),
      with_attribute("NormalsThatAreNoNumbers", "NORMAL", std::vector<float>(12, nan),
                     {"mesh 0", "4 normals without a direction"}),
      with_attribute("CoordinatesThatAreNoNumbers", "TEXCOORD_0", std::vector<float>(8, nan),
                     {"mesh 0", "4 texture coordinates"}),
      with_attribute("CoordinatesAllTheSame", "TEXCOORD_0", std::vector<float>(8, 0.5F)),
      with_attribute("CoordinatesOnALine", "TEXCOORD_0", {0, 0, 1, 0, 2, 0, 3, 0}),
      with_attribute("TrianglesInOnePlace", "POSITION", one_place),
      with_attribute("TrianglesOnALine", "POSITION", {-1, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0}),
      with_indices("SomeTrianglesWithoutArea", {0, 3, 2, 0, 2, 1, 0, 0, 1, 2, 2, 2}),
      without_normals(),
  };
}

// The arguments of `compare` after the scene.
Case comparison(const std::string& name, std::vector<std::string> arguments, std::vector<std::string> output) {
  arguments.insert(arguments.begin(), {"compare", "ribbed_plane", "--repeats", "1", "-o", "{}/out"});
  return {.name = name,
          .arguments = std::move(arguments),
          .output_has = std::move(output),
          .leaves = {"out/results.json", "out/index.html"}};
}

const std::vector<Case> frames{
    comparison("OnePixel", {"--size", "1x1", "--spp", "4", "--distance", "1"}, {"direct"}),
    comparison("OneSample", {"--size", "16x16", "--spp", "1", "--distance", "1"}, {"direct"}),
    comparison("NoWholePixelCovered", {"--size", "16x16", "--spp", "4", "--distance", "1000"},
               {"n/a", "the object does not cover a whole pixel"}),
    comparison("TilesOfOnePixel", {"--size", "4x4", "--spp", "2", "--distance", "1", "--tile", "1"}, {"direct"}),
    {.name = "NoLightFromTheFront",
     .arguments = {"compare", "{}/scene.toml", "--size", "16x16", "--spp", "2", "--repeats", "1", "-o", "{}/out"},
     .output_has = {"direct"},
     .files = {{"scene.toml", "[plane]\n[[light]]\ntype = \"directional\"\ndirection = [0, 0, 1]\n"}},
     .leaves = {"out/results.json"}},
};

// Two scenes, of which the second has two cameras and a sheen that is left out.
Case of_two_scenes(const std::string& name, std::vector<std::string> arguments) {
  GltfBuilder quad = make_bumpy_quad();
  quad.json["scenes"] = {{{"name", "bare"}, {"nodes", {0}}}, {{"name", "seen"}, {"nodes", {1, 2, 3}}}};
  quad.json["nodes"] = {{{"mesh", 0}},
                        {{"mesh", 0}},
                        {{"camera", 0}, {"translation", {0, 0, 3}}},
                        {{"camera", 0}, {"name", "near"}, {"translation", {0, 0, 2}}}};
  quad.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1e-9}}}}};
  quad.json["extensionsUsed"] = {"KHR_materials_sheen"};
  quad.json["extensionsRequired"] = {"KHR_materials_sheen"};
  arguments.insert(arguments.begin() + 1, "{}/quad.gltf");
  return {.name = name,
          .arguments = std::move(arguments),
          .files = {{"quad.gltf", quad.text()}, {"bumps.png", bumps_png()}}};
}

std::vector<Case> choices() {
  Case listed = of_two_scenes("Listed", {"explain", "--model-scene", "seen", "--size", "16x16"});
  listed.output_has = {"choices (* = selected)",
                       "0 `bare`, *1 `seen`",
                       "*0 `camera 0`, 1 `near`",
                       "the first of 2 cameras is used",
                       "KHR_materials_sheen is left out: sheen",
                       "memory of the maps"};
  Case in_json = of_two_scenes("ListedInJson", {"explain", "--camera", "near", "--model-scene", "1", "--json"});
  in_json.output_has = {"\"taken\": 1", "\"warnings\"", "\"decoded_maps\""};
  Case taken = of_two_scenes("Taken", {"render", "--method", "direct", "--model-scene", "1", "--camera", "near",
                                       "--size", "8x8", "-o", "{}/a.exr"});
  taken.leaves = {"a.exr"};
  Case wrong = of_two_scenes("Unknown", {"render", "--method", "direct", "--model-scene", "seem", "-o", "{}/a.exr"});
  wrong.exit_code = 2;
  wrong.errors_have = {"quad.gltf", "none that is called `seem`", "did you mean `seen`"};
  Case environment = of_two_scenes(
      "NoSuchEnvironment", {"render", "--method", "direct", "--environment", "{}/missing.exr", "-o", "{}/a.exr"});
  environment.exit_code = 2;
  environment.errors_have = {"missing.exr"};
  return {listed, in_json, taken, wrong, environment};
}

INSTANTIATE_TEST_SUITE_P(Choice, CommandLine, ::testing::ValuesIn(choices()), case_name);
INSTANTIATE_TEST_SUITE_P(OddModel, CommandLine, ::testing::ValuesIn(of_compare_and_render(models())), case_name);
INSTANTIATE_TEST_SUITE_P(OddFrame, CommandLine, ::testing::ValuesIn(frames), case_name);

}  // namespace
}  // namespace footprint::test
