// Broken and hostile glTF files through the program: exit code 2, the file and the place named, nothing left behind.
#include <limits>

#include "tests/command_line/bumpy_quad.hpp"
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

using nlohmann::json;

// The quad with its buffer in a file of its own, `bytes` longer or shorter than the document says.
std::map<std::string, std::string> with_buffer_file(int bytes) {
  const GltfBuilder quad = make_quad();
  json document = quad.json;
  document["buffers"] = {{{"byteLength", quad.data.size()}, {"uri", "quad.bin"}}};
  std::string data(quad.data.begin(), quad.data.end());
  data.resize(data.size() + static_cast<std::size_t>(bytes));
  return {{"quad.gltf", document.dump()}, {"quad.bin", data}};
}

// The quad's buffer as a data URI that has fewer bytes than the document says.
std::string cut_data_uri() {
  json document = json::parse(make_quad().text());
  document["buffers"][0]["byteLength"] = document["buffers"][0]["byteLength"].get<int>() + 8;
  return document.dump();
}

// The quad after `change` to its document.
template <typename Change>
std::string quad_with(Change change) {
  GltfBuilder quad = make_quad();
  change(quad);
  return quad.text();
}

std::string position_that_is_no_number() {
  return quad_with([](GltfBuilder& quad) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    primitive_of(quad)["attributes"]["POSITION"] = quad.add_floats({-1, 1, 0, 1, nan, 0, 1, -1, 0, -1, -1, 0}, "VEC3");
  });
}

// A .glb of which nothing but the name and the first four bytes is right.
std::string garbage(const std::string& start) {
  std::string bytes = start;
  for (unsigned i = 0; i < 1000; ++i) bytes += static_cast<char>(i * i * 31U >> 3U);
  return bytes;
}

std::vector<Case> buffers() {
  const std::string model = "{}/quad.gltf";
  const std::string glb = make_quad().glb();
  return {
      {.name = "BufferTooShort",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "quad.bin"},
       .files = with_buffer_file(-4)},
      {.name = "DataUriTooShort",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "buffers[0]", "byteLength"},
       .files = {{"quad.gltf", cut_data_uri()}}},
      {.name = "GlbCutShort",
       .arguments = {"{}/quad.glb"},
       .exit_code = 2,
       .errors_have = {"quad.glb"},
       .files = {{"quad.glb", glb.substr(0, glb.size() - 4)}}},
      {.name = "GlbOfGarbage",
       .arguments = {"{}/quad.glb"},
       .exit_code = 2,
       .errors_have = {"quad.glb"},
       .files = {{"quad.glb", garbage("")}}},
      {.name = "GlbOfGarbageAfterItsMagic",
       .arguments = {"{}/quad.glb"},
       .exit_code = 2,
       .errors_have = {"quad.glb"},
       .files = {{"quad.glb", garbage("glTF")}}},
  };
}

std::vector<Case> contents() {
  const std::string model = "{}/quad.gltf";
  const auto in_accessor = [](const char* key, int value) {
    return quad_with([=](GltfBuilder& quad) { quad.json["accessors"][0][key] = value; });
  };
  return {
      {.name = "AccessorOutOfRange",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "accessors[0]", "buffer view"},
       .files = {{"quad.gltf", in_accessor("count", 5)}}},
      {.name = "AccessorOfHostileLength",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "accessors[0]"},
       .files = {{"quad.gltf", in_accessor("count", std::numeric_limits<int>::max())}}},
      {.name = "IndexOutOfRange",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "`quad`", "vertex 4 of 4"},
       .files = {{"quad.gltf", quad_with([](GltfBuilder& quad) {
                    primitive_of(quad)["indices"] = quad.add_indices({0, 1, 4});
                  })}}},
      {.name = "PositionThatIsNoNumber",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "vertex 1"},
       .files = {{"quad.gltf", position_that_is_no_number()}}},
      {.name = "SceneWithoutNodes",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf"},
       .files = {{"quad.gltf", quad_with([](GltfBuilder& quad) { quad.json["scenes"] = {json::object()}; })}}},
      {.name = "SceneOfNothing",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf"},
       .files = {{"quad.gltf", R"({"asset": {"version": "2.0"}})"}}},
      {.name = "UnknownRequiredExtension",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "extensionsRequired", "KHR_texture_basisu"},
       .files = {{"quad.gltf",
                  quad_with([](GltfBuilder& quad) { quad.json["extensionsRequired"] = {"KHR_texture_basisu"}; })}}},
      {.name = "NotJson",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf", "line 2"},
       .files = {{"quad.gltf", "{\n\"asset\": \x1b[2J\xff"}}},
      {.name = "EmptyFile",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf"},
       .files = {{"quad.gltf", ""}}},
      {.name = "ModelThatIsAFolder",
       .arguments = {model},
       .exit_code = 2,
       .errors_have = {"quad.gltf"},
       .files = {{"quad.gltf/notes.txt", "a folder"}}},
  };
}

std::vector<Case> textures() {
  const std::string model = "{}/quad.gltf";
  const std::string whole = bumps_png();
  const auto row = [&](const std::string& name, const std::string& error, const std::string& png) {
    return Case{.name = name,
                .arguments = {model},
                .exit_code = 2,
                .errors_have = {"quad.gltf", "materials[0] `bumpy`", "bumps.png", error},
                .files = {{"quad.gltf", make_bumpy_quad().text()}, {"bumps.png", png}}};
  };
  Case missing = row("TextureMissing", "no such file", "");
  missing.files.erase("bumps.png");
  return {
      missing,
      row("TextureEmpty", "empty", ""),
      row("TextureThatIsNoImage", "not an image", "words, not an image"),
      row("TextureOfHostileSize", "100000 x 100000", png_text(100000, 100000, {"\0", 1})),
      row("TextureCutShort", "truncated", whole.substr(0, whole.size() - 6)),
  };
}

INSTANTIATE_TEST_SUITE_P(BadBuffer, CommandLine, ::testing::ValuesIn(of_compare_and_render(buffers())), case_name);
INSTANTIATE_TEST_SUITE_P(BadContent, CommandLine, ::testing::ValuesIn(of_compare_and_render(contents())), case_name);
INSTANTIATE_TEST_SUITE_P(BadTexture, CommandLine, ::testing::ValuesIn(of_compare_and_render(textures())), case_name);

}  // namespace
}  // namespace footprint::test
