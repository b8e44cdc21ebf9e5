// Wrong scene.toml files and wrong methods through the program: the line, the key and the nearest right one are named.
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

std::vector<Case> scenes() {
  const auto row = [](const std::string& name, std::vector<std::string> errors, const std::string& text) {
    return Case{.name = name,
                .arguments = {"{}/scene.toml"},
                .exit_code = 2,
                .errors_have = std::move(errors),
                .files = {{"scene.toml", text}}};
  };
  return {
      row("UnknownKey", {"scene.toml:3: ", "unknown key `normal_mapp` in [plane]", "did you mean `normal_map`?"},
          "[plane]\nsize = [1, 1]\nnormal_mapp = \"bumps.png\"\n"),
      row("UnknownTable", {"scene.toml:3: ", "unknown key `brfd`", "did you mean `brdf`?"},
          "[plane]\n\n[brfd]\nalpha = 0.1\n"),
      row("UnknownWord", {"scene.toml:3: ", "`bekmann`", "did you mean `beckmann`?"},
          "[plane]\n[brdf]\ndistribution = \"bekmann\"\n"),
      row("NumberThatIsNone", {"scene.toml:4: ", "`alpha` in [brdf] is nan"},
          "[plane]\n[brdf]\ndistribution = \"ggx\"\nalpha = nan\n"),
      row("NegativeNumber", {"scene.toml:2: ", "`size` in [plane] is -1"}, "[plane]\nsize = [-1, 2]\n"),
      row("NegativeDistance", {"scene.toml:3: ", "`distances` in [zoom] is -2"},
          "[plane]\n[zoom]\ndistances = [1, -2]\n"),
      row("InfiniteLight", {"scene.toml:5: ", "`intensity` in [[light]] is inf"},
          "[plane]\n[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\nintensity = inf\n"),
      row("WrongType", {"scene.toml:2: ", "`size` in [plane]"}, "[plane]\nsize = \"big\"\n"),
      row("HostileSize", {"scene.toml:3: ", "`size` in [frame]"}, "[plane]\n[frame]\nsize = [1000000, 1000000]\n"),
      row("NotToml", {"scene.toml:2: ", "not valid TOML"}, "[plane]\n[brdf\n"),
      row("EmptyScene", {"scene.toml: ", "empty"}, ""),
      row("NothingToShow", {"scene.toml:1: ", "`model` or `plane`"}, "# nothing\n"),
      row("MissingModel", {"scene.toml, ", "missing.gltf: no such file"}, "[model]\nfile = \"missing.gltf\"\n"),
      row("LobeInTheSurface", {"scene.toml:5: ", "`axis` in [[brdf.lobe]]", "horizon"},
          "[plane]\n[brdf]\ndistribution = \"vmf\"\n[[brdf.lobe]]\naxis = [0.7, 0.7, 0]\nkappa = 128\n"),
      row("LobesBesideAMap", {"scene.toml:7: ", "`kappa` in [maps] excludes [[brdf.lobe]]"},
          "[plane]\n[brdf]\ndistribution = \"vmf\"\n[[brdf.lobe]]\naxis = [0, 0, 1]\nkappa = 128\n"
          "[maps.kappa]\nfile = \"kappa.exr\"\n"),
      row("HeightsBesideNormals", {"scene.toml:3: ", "`height_map` in [plane] excludes `normal_map`"},
          "[plane]\nnormal_map = \"n.png\"\nheight_map = { file = \"h.png\", scale = 0.1 }\n"),
      row("HeightsWithoutScale", {"scene.toml:2: ", "`scale`", "missing"},
          "[plane]\nheight_map = { file = \"h.png\" }\n"),
      row("MissingHeights", {"scene.toml, ", "missing.png: no such file"},
          "[plane]\nheight_map = { file = \"missing.png\", scale = 0.1 }\n"),
      row("MissingMap", {"scene.toml, ", "missing.png: no such file"}, "[plane]\nnormal_map = \"missing.png\"\n"),
  };
}

std::vector<Case> methods() {
  const auto row = [](const std::string& name, const std::string& method, std::vector<std::string> errors) {
    return Case{.name = name,
                .arguments = {"compare", "ribbed_plane", "--methods", "direct," + method, "-o", "{}/out"},
                .exit_code = 2,
                .errors_have = std::move(errors)};
  };
  return {
      row("WrongMethodOption", "toksvig:storag=fp16", {"toksvig", "`storag`", "did you mean `storage`?"}),
      row("WrongMethodWord", "toksvig:storage=fp61", {"toksvig", "storage", "`fp61`", "did you mean `fp16`?"}),
      row("WrongMethodNumber", "toksvig:spread=5", {"toksvig", "spread", "`5`", "0 to 4"}),
      row("MethodNumberThatIsNone", "toksvig:spread=nan", {"toksvig", "spread", "`nan`"}),
      row("OptionOfNoMethod", "direct:storage=fp16", {"direct", "`storage`"}),
      row("OptionWithoutValue", "toksvig:storage", {"`storage`", "name=value"}),
      row("MethodTwice", "direct", {"direct", "twice"}),
      row("MethodWithoutName", ":storage=fp16", {"no name"}),
  };
}

const std::vector<Case> wrong_names{
    {.name = "WrongSceneName",
     .arguments = {"render", "ribbed_plan", "--method", "direct", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"ribbed_plan", "`ribbed_plane`"}},
    {.name = "TwoMethodsForOnePicture",
     .arguments = {"render", "ribbed_plane", "--method", "direct,toksvig", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"--method"}},
};

INSTANTIATE_TEST_SUITE_P(BadScene, CommandLine, ::testing::ValuesIn(of_compare_and_render(scenes())), case_name);
INSTANTIATE_TEST_SUITE_P(BadMethod, CommandLine, ::testing::ValuesIn(methods()), case_name);
INSTANTIATE_TEST_SUITE_P(BadName, CommandLine, ::testing::ValuesIn(wrong_names), case_name);

}  // namespace
}  // namespace footprint::test
