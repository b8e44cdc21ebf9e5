// Where the bytes of a document are: GLB chunks, data URIs and files; what is read though it is unusual, and what is
// refused as what it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::make_quad;

std::string error_of(const std::string& name, const std::string& text) {
  return test::usage_error([&] { return load_gltf(test::write_file(name, text)); });
}

void expect_quad(const Model& model) {
  const Mesh wanted = load_gltf(make_quad().write()).meshes.at(0);
  ASSERT_EQ(model.meshes.size(), 1U);
  EXPECT_EQ(model.meshes[0].indices, wanted.indices);
  ASSERT_EQ(model.meshes[0].vertices.size(), wanted.vertices.size());
  for (std::size_t i = 0; i < wanted.vertices.size(); ++i)
    EXPECT_EQ(model.meshes[0].vertices[i].position, wanted.vertices[i].position);
}

void expect_quad(const std::string& name, const std::string& text) {
  SCOPED_TRACE(name);
  try {
    expect_quad(load_gltf(test::write_file(name, text)));
  } catch (const Error& error) {
    ADD_FAILURE() << error.what();
  }
}

void expect_refused(const std::string& words, const std::string& name, const std::string& text) {
  const std::string error = error_of(name, text);
  EXPECT_NE(error.find(words), std::string::npos) << "wanted: " << words << "\ngot: " << error;
}

std::string word(std::size_t value) {
  std::string out;
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFFU);
  return out;
}

std::string chunk(const std::string& kind, const std::string& content) { return word(content.size()) + kind + content; }

// A GLB file of chunks after the JSON.
std::string glb(json document, const std::string& chunks, std::size_t length_beyond = 0) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string rest = chunk("JSON", text) + chunks;
  return "glTF" + word(2) + word(12 + rest.size() - length_beyond) + rest;
}

std::string bytes_of(const GltfBuilder& quad, std::size_t more = 0) {
  std::string bytes(quad.data.begin(), quad.data.end());
  return bytes + std::string(more, 'x');
}

json with_buffers(const json& buffers) {
  json document = make_quad().json;
  document["buffers"] = buffers;
  return document;
}

const std::string bin("BIN\0", 4);

TEST(GltfContainers, BytesBeyondWhatIsDeclaredHaveNoMeaning) {
  const GltfBuilder quad = make_quad();
  const std::size_t size = quad.data.size();
  test::write_file("longer.bin", bytes_of(quad, 36));
  expect_quad("longer.gltf", with_buffers({{{"byteLength", size}, {"uri", "longer.bin"}}}).dump());
  expect_quad("trailing.glb", quad.glb() + "more");
  const json own = with_buffers({{{"byteLength", size}}});
  expect_quad("chunk.glb", glb(own, chunk(bin, bytes_of(quad, 400))));
  expect_quad("length.glb", glb(own, chunk(bin, bytes_of(quad)) + "tail", 4));
  GltfBuilder longer = quad;  // its data URI too
  longer.data.resize(size + 5, 7);
  json document = json::parse(longer.text());
  document["buffers"][0]["byteLength"] = size;
  expect_quad("uri.gltf", document.dump());
  document["buffers"][0]["byteLength"] = size + 6;
  expect_refused("buffers[0]: its data URI has", "short.gltf", document.dump());
}

TEST(GltfContainers, UnknownChunksOfAGlbFileAreIgnored) {
  const GltfBuilder quad = make_quad();
  const json own = with_buffers({{{"byteLength", quad.data.size()}}});
  const std::string data = chunk(bin, bytes_of(quad)), odd = chunk("ODD!", "abcd"), empty = chunk("NONE", "");
  expect_quad("after.glb", glb(own, data + odd + empty));
  expect_quad("before.glb", glb(own, odd + data));
  expect_quad("second.glb", glb(own, data + chunk(bin, std::string(quad.data.size(), '\0'))));
  expect_refused("is cut off", "cut.glb", glb(own, data + "abcd"));
  expect_refused("is longer than the file", "long.glb", glb(own, data + word(100) + "ODD!"));
  expect_refused("no binary chunk", "none.glb", glb(own, odd));
  expect_refused("the binary chunk has 8 bytes", "less.glb", glb(own, chunk(bin, "abcdefgh")));
}

// glTF 2.0, section 3.6.1.2: the binary chunk is that of the first buffer.
TEST(GltfContainers, OnlyTheFirstBufferMayBeTheBinaryChunk) {
  const GltfBuilder quad = make_quad();
  const std::size_t size = quad.data.size();
  test::write_file("own.bin", bytes_of(quad));
  json document = with_buffers({{{"byteLength", size}, {"uri", "own.bin"}}, {{"byteLength", size}}});
  expect_refused("buffers[1]: has no URI", "second.glb", glb(document, chunk(bin, bytes_of(quad))));
  document = with_buffers({{{"byteLength", size}}, {{"byteLength", size}, {"uri", "own.bin"}}});
  for (json& view : document["bufferViews"]) view["buffer"] = 1;
  expect_quad("both.glb", glb(document, chunk(bin, std::string(size, '\0'))));
  expect_refused("buffers[0]: has no URI", "text.gltf", document.dump());
}

TEST(GltfContainers, Base64MayHaveLineBreaksAndEscapes) {
  const json document = json::parse(make_quad().text());
  const auto uri = document["buffers"][0]["uri"].get<std::string>();
  const std::size_t comma = uri.find(',') + 1;
  const auto with_uri = [&](const std::string& changed) {
    json copy = document;
    copy["buffers"][0]["uri"] = changed;
    return copy.dump();
  };
  std::string wrapped = uri.substr(0, comma), escaped = wrapped;
  for (std::size_t at = comma; at < uri.size(); at += 60) wrapped += uri.substr(at, 60) + "\r\n ";
  for (const char c : uri.substr(comma))
    escaped += c == '=' ? "%3D" : c == '/' ? "%2f" : c == '+' ? "%2B" : std::string(1, c);
  expect_quad("wrapped.gltf", with_uri(wrapped));
  expect_quad("escaped.gltf", with_uri(escaped));
  expect_quad("unpadded.gltf", with_uri(uri.substr(0, uri.find('='))));
  expect_quad("kind.gltf", with_uri("DATA:model/gltf;x=y;BASE64," + uri.substr(comma)));
  expect_refused("URL-safe", "safe.gltf", with_uri(uri.substr(0, comma + 8) + "-_" + uri.substr(comma + 10)));
  expect_refused("not base64", "odd.gltf", with_uri(uri.substr(0, comma + 8) + "!" + uri.substr(comma + 9)));
  expect_refused("cut off", "cut.gltf", with_uri(uri.substr(0, comma + 9)));
  expect_refused("data URI", "comma.gltf", with_uri("data:text/plain;base64"));
}

TEST(GltfContainers, NullMembersAreMissingAndWholeFloatsWholeNumbers) {
  GltfBuilder quad = make_quad();
  quad.json["nodes"][0]["name"] = nullptr;
  quad.json["nodes"][0]["skin"] = nullptr;
  quad.json["nodes"][0]["mesh"] = 0.0;
  quad.json["materials"] = {{{"normalTexture", nullptr}, {"extensions", nullptr}, {"vendor", 5}}};
  quad.json["accessors"][0]["count"] = 4.0;
  quad.json["accessors"][0]["sparse"] = nullptr;
  quad.json["bufferViews"][0]["byteStride"] = 12.0;
  for (const char* empty : {"textures", "images", "samplers", "cameras", "animations"})
    quad.json[empty] = json::array();
  expect_quad("odd.gltf", quad.text());
  quad.json["nodes"][0]["mesh"] = 0.5;
  expect_refused("nodes[0].mesh: must be a whole number", "half.gltf", quad.text());
  quad.json["nodes"][0]["mesh"] = 1e300;
  expect_refused("nodes[0].mesh: must be a whole number", "huge.gltf", quad.text());
  quad.json["nodes"][0]["mesh"] = 0;
  quad.json["accessors"][0]["count"] = nullptr;
  expect_refused("accessors[0].count: is missing", "null.gltf", quad.text());
  quad.json["accessors"][0]["count"] = 4;
  quad.json["scenes"][0]["nodes"][0] = nullptr;
  expect_refused("scenes[0].nodes[0]: must be a whole number", "element.gltf", quad.text());
}

TEST(GltfContainers, UnknownMembersHaveNoMeaning) {
  GltfBuilder quad = make_quad();
  quad.json["cameras"] = {{{"type", "orthographic"},
                           {"vendor", {1, "x"}},
                           {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}, {"vendor", "x"}}}}};
  quad.json["nodes"][0]["camera"] = 0;
  quad.json["nodes"][0]["vendor"] = "x";
  quad.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"vendor", "x"}}}}};
  expect_quad("vendor.gltf", quad.text());
}

TEST(GltfContainers, AccessorsHaveKindsOfGltf) {
  GltfBuilder quad = make_quad();
  quad.json["accessors"][0]["type"] = "VEC5";
  expect_refused("accessors[0].type: `VEC5`", "type.gltf", quad.text());
  quad = make_quad();
  quad.json["accessors"][0]["componentType"] = 7;
  expect_refused("accessors[0].componentType: 7", "component.gltf", quad.text());
}

// A quad whose buffer and whose normal map are files named by URIs.
std::string with_uris(const std::string& buffer, const std::string& image) {
  json document = with_buffers({{{"byteLength", make_quad().data.size()}, {"uri", buffer}}});
  document["images"] = {{{"uri", image}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  return document.dump();
}

std::string percent_encoded(const std::string& name) {
  std::string out;
  for (const char c : name) out += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  return out;
}

TEST(GltfUris, LocalFilesAreNamedAlikeForBuffersAndImages) {
  GltfBuilder quad = make_quad();
  quad.add_texture(Image(2, 2, 3, 0.75F));  // writes texture.png
  const std::filesystem::path folder = test::process_folder(), picture = folder / "texture.png";
  for (const std::string name : {"plain", "with blank", "100%", "a+b", "a#b?c", "\xC3\xBC\xE6\xBC\xA2", "a%20b", "x:y",
                                 "back\\slash", "sub/../sub/./deep"}) {
    test::write_file(name + ".bin", bytes_of(make_quad()));
    std::filesystem::copy_file(picture, folder / (name + ".png"), std::filesystem::copy_options::overwrite_existing);
    const std::string bin_name = name + ".bin", png_name = name + ".png";
    if (name != "x:y") expect_quad("raw " + std::to_string(name.size()) + ".gltf", with_uris(bin_name, png_name));
    expect_quad("encoded.gltf", with_uris(percent_encoded(bin_name), percent_encoded(png_name)));
  }
  const std::string absolute = folder.string() + "/plain";
  expect_quad("absolute.gltf", with_uris(absolute + ".bin", absolute + ".png"));
  for (const char* scheme : {"file://", "FILE://localhost", "file:"})
    expect_quad("file.gltf", with_uris(scheme + absolute + ".bin", scheme + absolute + ".png"));
  expect_quad("query.gltf", with_uris("plain.bin?v=2", "plain.png#part"));
}

TEST(GltfUris, RefusedOnesAreNamedAsWhatTheyAre) {
  test::write_file("plain.bin", bytes_of(make_quad()));
  test::write_file("sub/plain.bin", bytes_of(make_quad()));
  const std::vector<std::pair<std::string, std::string>> faults{
      {"missing.bin", "no such file"},
      {"sub\\plain.bin", "has a backslash"},
      {"sub%5Cplain.bin", "has a backslash"},
      {"PLAIN.bin", "`plain.bin` beside it differs in upper and lower case"},
      {"none#1.bin", "`#` begins a fragment"},
      {"plain.bin%00.bin", "a byte of 0"},
      {"https://example.org/plain.bin", "not fetched from the network"},
      {"//example.org/plain.bin", "not fetched from the network"},
      {"blob:plain.bin", "the scheme `blob`, which is not read"},
      {"file://host/plain.bin", "a file of another machine"},
      {"C:\\plain.bin", "has a backslash"}};
  for (const auto& [uri, words] : faults) {
    expect_refused(words, "fault.gltf", with_uris(uri, "plain.bin"));
    expect_refused(words, "fault.gltf", with_uris("plain.bin", uri));
  }
}

}  // namespace
}  // namespace footprint
