// The figures of fits against the numbers that the paper prints, and against cases that are known.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <gtest/gtest.h>

#include <array>

#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {
namespace {

struct Row {
  double sharpness1, sharpness2, largest, printed;
};

// Figure 5 and its discussion; `largest` computed apart in Python with 50 digits, `printed` as in the paper.
TEST(FitError, ConvolutionErrorIsThatOfFigure5) {
  const std::array<Row, 7> rows{{{1, 10, 0.012946205881434969, 1.3e-2},
                                 {1, 1000, 1.4470265248698808e-06, 1.4e-6},
                                 {10, 10000, 1.4459944094912577e-08, 1.4e-8},
                                 {100, 1000, 1.1981971156410816e-06, 1.2e-6},
                                 {1, 4, 0.0702638849703957, 0.070},
                                 {1, 6, 0.03365664843704813, 0.034},
                                 {1, 8, 0.01971646571076069, 0.020}}};
  for (const Row& row : rows) {
    const double error = convolution_error(row.sharpness1, row.sharpness2);
    EXPECT_NEAR(error / row.largest, 1.0, 1e-5) << row.sharpness1 << " " << row.sharpness2;
    EXPECT_NEAR(error / row.printed, 1.0, 0.05);
    EXPECT_NEAR(convolution_error(row.sharpness2, row.sharpness1) / error, 1.0, 1e-5);
  }
}

TEST(FitError, JakobsIsThatOfTheDiscussion) {
  const std::array<Row, 4> rows{{{1, 10, 0.008746847828899784, 8.7e-3},
                                 {1, 1000, 1.174224075533789e-06, 1.2e-6},
                                 {10, 10000, 3.6108855895188464e-08, 3.6e-8},
                                 {100, 1000, 2.9920381356685066e-06, 3.0e-6}}};
  for (const Row& row : rows) {
    EXPECT_NEAR(jakob_convolution_error(row.sharpness1, row.sharpness2) / row.largest, 1.0, 1e-4);
  }
}

TableSettings small() {
  TableSettings settings;
  settings.side = 4;
  settings.facets = 2000;
  settings.paints.resize(1);
  return settings;
}

// A plane is one normal, which its lobe represents.
TEST(FitError, APlaneIsFittedExactly) {
  EXPECT_LT(fit_errors(make_patch(find_patch_kind("flat"), {}), small()).relative, 1e-3);
}

// Four normals far apart: four lobes stand for them; one does not.
TEST(FitError, FewerLobesThanNormalsLeaveMore) {
  const Patch pyramids = make_patch(find_patch_kind("pyramids"), {{"floor", "0"}});
  TableSettings settings = small();
  settings.lobes = 4;
  const double four = fit_errors(pyramids, settings).relative;
  settings.lobes = 1;
  const double one = fit_errors(pyramids, settings).relative;
  EXPECT_LT(four, 0.01);
  EXPECT_GT(one, 0.5);
  EXPECT_NEAR(fit_errors(pyramids, settings).rms / one,
              fit_errors(pyramids, small()).rms / fit_errors(pyramids, small()).relative, 1e-3);
}

// Wider lobes hide more of the difference. Between the sharpest and themselves, lobes differ as they are.
TEST(FitError, AConvolutionHidesWhatIsFinerThanItsLobe) {
  const Patch pyramids = make_patch(find_patch_kind("pyramids"), {{"floor", "0"}});
  TableSettings settings = small();
  settings.lobes = 4;
  EXPECT_LT(convolved_fit_rms(pyramids, settings, 513.0), 0.01);
  settings.lobes = 1;
  const double sharp = convolved_fit_rms(pyramids, settings, 1e5), wide = convolved_fit_rms(pyramids, settings, 2.0);
  EXPECT_NEAR(sharp / fit_errors(pyramids, settings).relative, 1.0, 0.1);
  EXPECT_LT(wide, 0.5 * sharp);
}

// Cells without facets add only what lobes put there, and are most of all cells.
TEST(FitError, OccupiedCellsAreTheFewWithFacets) {
  const Patch pyramids = make_patch(find_patch_kind("pyramids"), {{"floor", "0"}});
  TableSettings settings = small();
  settings.lobes = 1;
  EXPECT_GT(fit_errors(pyramids, settings).occupied, 5.0 * fit_errors(pyramids, settings).rms);
}

}  // namespace
}  // namespace footprint::iwasaki_sg
