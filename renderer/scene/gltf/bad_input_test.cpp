// Broken and hostile glTF files: one clear error each, before memory is taken.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/png_file.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::make_quad;
using test::usage_error;

std::string error_of(const std::filesystem::path& file) {
  return usage_error([&] { return load_gltf(file); });
}

/// The error of the quad after `change`, which must name `place`.
void expect_error(const std::string& place, const std::function<void(GltfBuilder&)>& change) {
  GltfBuilder quad = make_quad();
  change(quad);
  const std::string error = error_of(quad.write());
  EXPECT_NE(error.find(place), std::string::npos) << "wanted: " << place << "\ngot: " << error;
  EXPECT_NE(error.find("made.gltf"), std::string::npos) << error;
}

json& primitive(GltfBuilder& quad) { return quad.json["meshes"][0]["primitives"][0]; }

TEST(GltfBadInput, FilesThatAreNoGltf) {
  EXPECT_NE(error_of(test::process_folder() / "nowhere.gltf").find("no such file"), std::string::npos);
  EXPECT_NE(error_of(test::process_folder()).find("not a regular file"), std::string::npos);
  EXPECT_NE(error_of("/dev/zero").find("not a regular file"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("empty.gltf", "")).find("empty"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("words.gltf", "hello world")).find("not valid JSON"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("array.gltf", "[1, 2, 3]")).find("not an object"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("bare.gltf", "{\"nodes\": []}")).find("asset.version"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("big.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e999}")).find("JSON"),
            std::string::npos);
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_NE(error_of(test::write_file("deep.gltf", deep)).find("nested"), std::string::npos);
}

TEST(GltfBadInput, VersionAndExtensions) {
  expect_error("glTF 1.0 is not supported", [](GltfBuilder& quad) { quad.json["asset"]["version"] = "1.0"; });
  expect_error("KHR_texture_basisu (KTX2 textures (Basis Universal)), EXT_other", [](GltfBuilder& quad) {
    quad.json["extensionsRequired"] = {"KHR_texture_transform", "KHR_texture_basisu", "EXT_other"};
  });
}

TEST(GltfBadInput, TypesAndIndices) {
  expect_error("meshes: must be an array", [](GltfBuilder& quad) {
    quad.json.erase("nodes");
    quad.json.erase("scenes");
    quad.json["meshes"] = "none";
  });
  expect_error("nodes[0].mesh: index 7 is out of range: `meshes` has 1",
               [](GltfBuilder& quad) { quad.json["nodes"][0]["mesh"] = 7; });
  expect_error("nodes[0].mesh: index -1", [](GltfBuilder& quad) { quad.json["nodes"][0]["mesh"] = -1; });
  expect_error("nodes[0].mesh", [](GltfBuilder& quad) { quad.json["nodes"][0]["mesh"] = std::uint64_t{1} << 32U; });
  expect_error("nodes[0].matrix: must be an array of 16 numbers", [](GltfBuilder& quad) {
    quad.json["nodes"][0]["matrix"] = {1, 2};
  });
  expect_error("meshes[0].primitives[0].attributes.POSITION",
               [](GltfBuilder& quad) { primitive(quad)["attributes"]["POSITION"] = 99; });
  expect_error("scenes[0].nodes[0]", [](GltfBuilder& quad) { quad.json["scenes"][0]["nodes"] = {1}; });
  expect_error("mode", [](GltfBuilder& quad) { primitive(quad)["mode"] = 7; });
  expect_error("accessors[0].count: is missing", [](GltfBuilder& quad) { quad.json["accessors"][0].erase("count"); });
}

TEST(GltfBadInput, Buffers) {
  const auto with_buffers = [](const json& buffers) {
    json document = make_quad().json;
    document["buffers"] = buffers;
    return error_of(test::write_file("buffers.gltf", document.dump()));
  };
  const std::size_t size = make_quad().data.size();
  EXPECT_NE(with_buffers({{{"byteLength", size}, {"uri", "missing.bin"}}}).find("missing.bin"), std::string::npos);
  EXPECT_NE(with_buffers({{{"byteLength", size}, {"uri", "https://example.org/a.bin"}}}).find("network"),
            std::string::npos);
  EXPECT_NE(with_buffers({{{"byteLength", size}, {"uri", "data:text/html,hello"}}}).find("data URI"),
            std::string::npos);
  EXPECT_NE(with_buffers({{{"byteLength", size}, {"uri", "/dev/zero"}}}).find("zero"), std::string::npos);
  const std::string bytes(size, 'x');
  test::write_file("short.bin", bytes.substr(0, size - 4));
  test::write_file("nothing.bin", "");
  for (const char* name : {"short.bin", "nothing.bin"}) {
    EXPECT_NE(with_buffers({{{"byteLength", size}, {"uri", name}}}).find(name), std::string::npos) << name;
  }
}

TEST(GltfBadInput, ViewsAndAccessorsOutOfRange) {
  const std::int64_t largest = std::numeric_limits<std::int32_t>::max() - 1;
  expect_error("bufferViews[0]", [](GltfBuilder& quad) { quad.json["bufferViews"][0]["byteLength"] = 100000; });
  expect_error("bufferViews[0]", [=](GltfBuilder& quad) { quad.json["bufferViews"][0]["byteOffset"] = largest; });
  expect_error("bufferViews[0].byteLength", [](GltfBuilder& quad) { quad.json["bufferViews"][0]["byteLength"] = 0; });
  expect_error("accessors[0]", [](GltfBuilder& quad) { quad.json["accessors"][0]["byteOffset"] = 4; });
  expect_error("accessors[0]", [=](GltfBuilder& quad) { quad.json["accessors"][0]["byteOffset"] = largest; });
  expect_error("accessors[0]", [](GltfBuilder& quad) { quad.json["accessors"][0]["count"] = 5; });
  expect_error("accessors[0]", [](GltfBuilder& quad) { quad.json["accessors"][0]["count"] = 0; });
  expect_error("accessors[0]", [=](GltfBuilder& quad) { quad.json["accessors"][0]["count"] = largest; });
  expect_error("accessors[0].count", [](GltfBuilder& quad) {
    quad.json["accessors"][0]["count"] = std::numeric_limits<std::uint64_t>::max();
  });
  expect_error("accessors[0]: 2000000 elements", [](GltfBuilder& quad) {
    quad.json["accessors"][0].erase("bufferView");
    quad.json["accessors"][0]["count"] = 2000000;
  });
  expect_error("the stride", [](GltfBuilder& quad) { quad.json["bufferViews"][0]["byteStride"] = 8; });
  expect_error("accessors[0]", [](GltfBuilder& quad) { quad.json["accessors"][0]["type"] = "VEC4"; });
  expect_error("accessors[0]", [](GltfBuilder& quad) { quad.json["accessors"][0]["componentType"] = 5125; });
  expect_error("NORMAL: has 3 elements", [](GltfBuilder& quad) { quad.json["accessors"][1]["count"] = 3; });
}

TEST(GltfBadInput, SparseAccessors) {
  const auto sparse = [](GltfBuilder& quad, const std::vector<std::uint8_t>& indices, int count) {
    const int index_view = quad.add_view(indices);
    const int value_view = quad.add_view(std::vector<std::uint8_t>(24, 0));
    quad.json["accessors"][0]["sparse"] = {{"count", count},
                                           {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", value_view}}}};
  };
  expect_error("does not rise", [&](GltfBuilder& quad) { sparse(quad, {2, 1}, 2); });
  expect_error("out of range", [&](GltfBuilder& quad) { sparse(quad, {1, 200}, 2); });
  expect_error("accessors[0].sparse", [&](GltfBuilder& quad) { sparse(quad, {0, 1}, 5); });
  expect_error("accessors[0].sparse.values", [&](GltfBuilder& quad) { sparse(quad, {0, 1, 2}, 3); });
}

TEST(GltfBadInput, IndicesNameTheirVertex) {
  expect_error("mesh 0 `quad`, primitive 0, index 2: names vertex 4 of 4", [](GltfBuilder& quad) {
    primitive(quad)["indices"] = quad.add_indices({0, 1, 4});
  });
}

TEST(GltfBadInput, PositionsMustBeFinite) {
  for (const float bad : {NAN, INFINITY}) {
    expect_error("mesh 0 `quad`, primitive 0, vertex 2: the position is not finite", [&](GltfBuilder& quad) {
      const int positions = quad.add_floats({0, 0, 0, 1, 0, 0, 1, bad, 0, 0, 1, 0}, "VEC3");
      primitive(quad)["attributes"]["POSITION"] = positions;
    });
  }
  expect_error("vertex 0: is beyond", [](GltfBuilder& quad) { quad.json["nodes"][0]["scale"] = {1e300, 1, 1}; });
}

TEST(GltfBadInput, NodesMustBeTrees) {
  expect_error("reached twice", [](GltfBuilder& quad) { quad.json["nodes"][0]["children"] = {0}; });
  expect_error("reached twice", [](GltfBuilder& quad) {
    quad.json["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
  });
  expect_error("nodes deep", [](GltfBuilder& quad) {
    quad.json["nodes"] = json::array();
    for (int i = 1; i < 3000; ++i) quad.json["nodes"].push_back({{"children", {i}}});
    quad.json["nodes"].push_back({{"mesh", 0}});
  });
}

TEST(GltfBadInput, CamerasAndLights) {
  const auto with_camera = [](const json& camera) {
    return [camera](GltfBuilder& quad) {
      quad.json["cameras"] = {camera};
      quad.json["nodes"][0]["camera"] = 0;
    };
  };
  const auto perspective = [&](double yfov, double znear, double zfar) {
    return with_camera({{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", znear}, {"zfar", zfar}}}});
  };
  expect_error("yfov", perspective(4.0, 0.1, 1.0));
  expect_error("yfov", perspective(0.0, 0.1, 1.0));
  expect_error("znear", perspective(1.0, 0.0, 1.0));
  expect_error("zfar", perspective(1.0, 2.0, 1.0));
  expect_error("fisheye", with_camera({{"type", "fisheye"}}));
  const auto with_light = [](const json& light) {
    return [light](GltfBuilder& quad) {
      quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
      quad.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    };
  };
  expect_error("intensity", with_light({{"type", "point"}, {"intensity", -1}}));
  expect_error("none of point", with_light({{"type", "area"}}));
  expect_error("ConeAngle", with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 1.0}}}}));
}

void add_normal_map(GltfBuilder& quad, const json& image) {
  quad.json["images"] = {image};
  quad.json["textures"] = {{{"source", 0}}};
  quad.json["materials"] = {{{"name", "bumpy"}, {"normalTexture", {{"index", 0}}}}};
  primitive(quad)["material"] = 0;
}

TEST(GltfBadInput, TexturesNameMaterialAndFile) {
  test::write_file("empty.png", "");
  test::write_file("words.png", "this is not an image at all");
  for (const char* name : {"missing.png", "empty.png", "words.png"}) {
    expect_error(name, [&](GltfBuilder& quad) { add_normal_map(quad, {{"uri", name}}); });
    expect_error("materials[0] `bumpy`", [&](GltfBuilder& quad) { add_normal_map(quad, {{"uri", name}}); });
  }
  expect_error("images[0]", [](GltfBuilder& quad) {
    add_normal_map(quad, {{"bufferView", 0}, {"mimeType", "image/png"}});  // positions, not a PNG
  });
  expect_error("network", [](GltfBuilder& quad) { add_normal_map(quad, {{"uri", "http://example.org/a.png"}}); });
}

TEST(GltfBadInput, TexturesOfHostileSizeAreRefusedFromTheHeader) {
  // A PNG header that promises 2^31 - 1 texels per side, and nothing behind it.
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x06\0\0\0\x52\x05\x8e\x6d", 33);
  test::write_file("huge.png", png);
  expect_error("huge.png", [](GltfBuilder& quad) { add_normal_map(quad, {{"uri", "huge.png"}}); });
}

TEST(GltfBadInput, MaterialFactorsOutOfRange) {
  expect_error("roughnessFactor", [](GltfBuilder& quad) {
    quad.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 2.0}}}}};
    primitive(quad)["material"] = 0;
  });
  expect_error("alphaMode", [](GltfBuilder& quad) {
    quad.json["materials"] = {{{"alphaMode", "GLASS"}}};
    primitive(quad)["material"] = 0;
  });
}

TEST(GltfBadInput, Anisotropy) {
  const auto with = [](const json& extension) {
    return [extension](GltfBuilder& quad) {
      quad.json["materials"] = {{{"extensions", {{"KHR_materials_anisotropy", extension}}}}};
      primitive(quad)["material"] = 0;
    };
  };
  expect_error("anisotropyStrength: must be a number", with({{"anisotropyStrength", "much"}}));
  expect_error("anisotropyStrength: 2 is not within 0 to 1", with({{"anisotropyStrength", 2.0}}));
  expect_error("anisotropyRotation", with({{"anisotropyRotation", 1e300}}));
  expect_error("anisotropyTexture", with({{"anisotropyStrength", 1.0}, {"anisotropyTexture", {{"index", 7}}}}));
}

TEST(GltfBadInput, ClearCoats) {
  const auto with_coat = [](const json& coat) {
    return [coat](GltfBuilder& quad) {
      quad.json["materials"] = {{{"extensions", {{"KHR_materials_clearcoat", coat}}}}};
      primitive(quad)["material"] = 0;
    };
  };
  expect_error("materials[0].extensions.KHR_materials_clearcoat: must be an object", with_coat(1));
  expect_error("clearcoatFactor: must be a number", with_coat({{"clearcoatFactor", "thick"}}));
  expect_error("clearcoatFactor: 2 is not within 0 to 1", with_coat({{"clearcoatFactor", 2.0}}));
  expect_error("clearcoatRoughnessFactor", with_coat({{"clearcoatFactor", 1.0}, {"clearcoatRoughnessFactor", -1.0}}));
  for (const char* texture : {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"}) {
    expect_error(std::string(texture) + ".index: index 7 is out of range",
                 with_coat({{"clearcoatFactor", 1.0}, {texture, {{"index", 7}}}}));
    expect_error(std::string(texture) + ".index: is missing", with_coat({{texture, json::object()}}));
    expect_error(std::string(texture) + ": must be an object", with_coat({{texture, json::array()}}));
  }
}

TEST(GltfBadInput, GlbContainers) {
  const std::string whole = make_quad().glb();
  const auto changed = [&](std::size_t offset, char value) {
    std::string file = whole;
    file[offset] = value;
    return error_of(test::write_file("changed.glb", file));
  };
  EXPECT_NE(changed(4, 1).find("version 1"), std::string::npos);
  EXPECT_NE(changed(8, 1).find("GLB container"), std::string::npos);
  EXPECT_NE(changed(14, 127).find("GLB container"), std::string::npos);
  EXPECT_NE(changed(16, 'X').find("GLB container"), std::string::npos);
  for (const std::size_t size : {std::size_t{4}, std::size_t{12}, std::size_t{19}, whole.size() - 1}) {
    EXPECT_FALSE(error_of(test::write_file("cut.glb", whole.substr(0, size))).empty()) << size;
  }
}

// By their headers the maps exceed memory, which is reported before any of them is decoded.
TEST(GltfBadInput, MapsThatMemoryDoesNotHoldAreRefusedBeforeTheWork) {
  constexpr std::uint32_t side = 16384;
  const std::uint64_t map_bytes = std::uint64_t{side} * side * 16;
  test::GltfBuilder quad = test::make_quad();
  const std::vector<std::uint8_t> png = test::png_file(side, side, 8, test::PngColor::rgb, {});
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  for (std::uint64_t i = 0; i < available_memory() / map_bytes + 2; ++i) {
    const int view = quad.add_view(png);
    quad.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    quad.json["textures"].push_back({{"source", i}});
    quad.json["materials"].push_back({{"normalTexture", {{"index", i}}}});
  }
  try {
    (void)load_gltf(quad.write());
    ADD_FAILURE() << "was loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine) << error.what();
    EXPECT_NE(std::string(error.what()).find("decoding the model's maps needs"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace footprint
