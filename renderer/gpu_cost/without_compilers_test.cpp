// What a build without Vulkan's headers, glslang or SPIRV-Cross answers: one error that names them and the packages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/gpu_cost/vulkan_compiler.hpp"
#include "renderer/languages/compilers.hpp"
#include "renderer/languages/translation.hpp"

namespace footprint {
namespace {

using ::testing::HasSubstr;

// Expects the error of the missing component at `place`.
void expect_refusal(const char* place, const auto& work) {
  try {
    work();
    ADD_FAILURE() << place << ": was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    for (const char* part : {place, "built without glslang and SPIRV-Cross", "libspirv-cross-c-shared-dev"})
      EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(WithoutCompilers, IsCheckedBeforeWorkBegins) {
  expect_refusal("--gpu", [] { require_compilers("--gpu"); });
}

TEST(WithoutCompilers, NothingIsCompiledOrTranslated) {
  expect_refusal("Vulkan", [] { (void)vulkan_compiler(); });
  expect_refusal("a program", [] { (void)spirv_program("a program", "", ""); });
  expect_refusal("a method", [] { (void)fragment_spirv("a method", ""); });
  expect_refusal("inputs", [] { (void)shader_inputs({}); });
  expect_refusal("hlsl", [] { (void)translate({}, ShaderLanguage::hlsl, ""); });
}

}  // namespace
}  // namespace footprint
