// Pictures that an earlier animation.json lists go, so that frames of two runs do not stand side by side.
#include "app/written_animation.hpp"

#include <fmt/format.h>

#include "app/output.hpp"
#include "app/standard_output.hpp"

namespace footprint {

void write_and_print(const std::filesystem::path& output,
                     const std::function<Animation(const std::filesystem::path& folder)>& make) {
  const auto [animation, path] = write_whole(output, [&](OutputFolder& folder) {
    Animation made = make(folder.path());
    keep_results(made, folder, write_animation, "animation.json");
    return made;
  });
  write_output(fmt::format("{}\nframes: {}\npage: {}\n", animation_table(animation), (path / "images").string(),
                           (path / "index.html").string()));
}

}  // namespace footprint
