// The names of GPUs, as users write them.
#include "renderer/core/gpu_chips.hpp"

#include <gtest/gtest.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

TEST(Chips, AreFoundByNameInAnyCase) {
  EXPECT_EQ(chips_named("--gpu", {"steam deck"}).front()->family, "VANGOGH");
  EXPECT_EQ(chips_named("--gpu", {"all"}).size(), chips().size());
  try {
    (void)chips_named("--gpu", {"RX 6900"});
    FAIL() << "found";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("rx 6800"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace footprint
