// Parts as JSON.
#include "app/part_file.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

constexpr const char* schema = "footprint-part/1";
constexpr auto part_kinds = std::to_array<Word<PartKind>>(
    {{PartKind::experiment, "experiment"}, {PartKind::animation, "animation"}, {PartKind::region, "region"}});
constexpr int most_shards = 100000;
constexpr int most_processes = 64, most_tile = 1 << 16;  // as the options of a run have them

Error damaged(const std::filesystem::path& file) {
  return {ErrorKind::usage, file.string(), "is damaged", "run that part again"};
}

// A number that a part may have; JSON has any. Errors (usage): another, or none.
int whole_number(const nlohmann::json& value, int least, int most, const std::filesystem::path& file) {
  if (!value.is_number_integer() || value < least || value > most) throw damaged(file);
  return value.get<int>();
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view all = text;
  const Shard shard{.index = parse_whole_of<int>(all.substr(0, slash)).value_or(0),
                    .count = slash < text.size() ? parse_whole_of<int>(all.substr(slash + 1)).value_or(0) : 0};
  if (shard.index >= 1 && shard.count >= shard.index && shard.count <= most_shards) return shard;
  throw Error(ErrorKind::usage, "--shard", fmt::format("`{:.80}` is not a part", text),
              "give I/N, part I of N, for example 1/4");
}

std::pair<std::size_t, std::size_t> range_of(const Shard& shard, std::size_t total) {
  const auto count = static_cast<std::size_t>(shard.count), index = static_cast<std::size_t>(shard.index);
  return {(index - 1) * total / count, index * total / count};
}

void write_part_file(const std::filesystem::path& folder, const PartFile& part) {
  const nlohmann::ordered_json document{{"schema", schema},
                                        {"kind", word_for(part_kinds, part.kind)},
                                        {"experiment", part.experiment},
                                        {"fingerprint", part.fingerprint},
                                        {"maker", part.maker},
                                        {"shard", {part.shard.index, part.shard.count}},
                                        {"only", part.only},
                                        {"quick", part.quick},
                                        {"processes", part.processes},
                                        {"tile", part.tile},
                                        {"node", part.node},
                                        {"seconds", part.seconds},
                                        {"keys", part.keys}};
  write_file_atomically(folder / "part.json",
                        document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

PartFile read_part_file(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "part.json";
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw Error(ErrorKind::usage, file.string(),
                "is missing: the folder is not a part of a run, or the part is unfinished",
                "run it with --shard I/N until it ends");
  try {
    const nlohmann::json document = nlohmann::json::parse(stream);
    if (document.at("schema") != schema)
      throw Error(ErrorKind::usage, file.string(), "is of another format", "run it again");
    const std::string kind = document.at("kind");
    const int count = whole_number(document.at("shard").at(1), 1, most_shards, file);
    return {.kind = word_value(part_kinds, kind, "kind of part", file.string()),
            .experiment = document.at("experiment"),
            .fingerprint = document.at("fingerprint"),
            .maker = document.at("maker"),
            .shard = {.index = whole_number(document.at("shard").at(0), 1, count, file), .count = count},
            .only = document.at("only"),
            .quick = document.at("quick"),
            .processes = whole_number(document.at("processes"), 1, most_processes, file),
            .tile = whole_number(document.at("tile"), 0, most_tile, file),
            .node = document.at("node"),
            .seconds = document.at("seconds"),
            .keys = document.at("keys").get<std::vector<std::string>>()};
  } catch (const nlohmann::json::exception&) {
    throw damaged(file);
  }
}

}  // namespace footprint
