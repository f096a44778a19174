/// Joints whose strength scatters: which face is strong follows from the seed and its elements alone.

#include "sazare/methods/blocks/run/joints/strength_scatter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sazare/parallel/threads.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::block_case, test::block_model, test::read_manifest, test::run_quietly, test::TemporaryFolder;

/// The factor of each joint, by the numbers of its elements.
std::map<std::pair<std::int64_t, std::int64_t>, Real> factors_of(const std::vector<std::string>& settings) {
  const cases::CaseFile file = block_case(settings);
  const BlocksModel model = block_model(file);
  std::map<std::pair<std::int64_t, std::int64_t>, Real> factors;
  const auto links = model.joints->links();
  for (Index joint = 0; joint < static_cast<Index>(links.size()); ++joint) {
    const auto tags = std::minmax(
        {geometry::element_tag(model.mesh, links[at(joint)].first), geometry::element_tag(model.mesh, links[at(joint)].second)});
    factors[tags] = model.kinds.factor[at(model.joints->record(joint).kind)];
  }
  return factors;
}

TEST(strength_scatter, has_the_mean_and_the_spread_asked_for) {
  const auto factors = factors_of({"joints.0.weibull_modulus=4.0"});
  Real mean = 0, square = 0;
  const auto count = static_cast<Real>(factors.size());
  for (const auto& [tags, factor] : factors) {
    mean += factor / count;
    square += factor * factor / count;
  }
  const Real spread = std::sqrt(std::tgamma(1.5) / std::pow(std::tgamma(1.25), 2) - 1);
  EXPECT_NEAR(mean, 1, 4 * spread / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(square - mean * mean), spread, 4 * spread / std::sqrt(2 * count));
}

TEST(strength_scatter, follows_from_the_seed) {
  const auto first = factors_of({"joints.0.weibull_modulus=4.0"}), again = factors_of({"joints.0.weibull_modulus=4.0"}),
             other = factors_of({"joints.0.weibull_modulus=4.0", "joints.0.scatter_seed=2"});
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
  for (const auto& [tags, factor] : factors_of({})) EXPECT_EQ(factor, 1);
}

TEST(strength_scatter, scales_strengths_and_energies_alike) {
  const cases::CaseFile file = block_case({"joints.0.law=\"mixed_mode\"", "joints.0.shear_fracture_energy=400.0"});
  const cases::Joint& joint = file.as<cases::BlocksCase>().joints[0];
  const cases::Joint weak = joint.scaled(0.5);
  EXPECT_EQ(weak.tensile_strength, 0.5 * joint.tensile_strength);
  EXPECT_EQ(weak.cohesion, 0.5 * joint.cohesion);
  EXPECT_EQ(weak.fracture_energy, 0.5 * joint.fracture_energy);
  EXPECT_EQ(weak.law_parameters[0], 200.0);
  EXPECT_EQ(weak.friction_coefficient, joint.friction_coefficient);
}

/// Weak faces break first and strong ones hold, so the state at the end is another one; it is the same on any number of threads,
/// and for a run that was stopped and resumed.
TEST(strength_scatter, leaves_the_same_state_on_any_number_of_threads) {
  const TemporaryFolder folder;
  const auto hash_of = [&](const std::string& name, std::vector<std::string> settings, int threads) {
    parallel::set_threads(threads);
    const cases::CaseFile file = block_case(std::move(settings));
    run_quietly(file, folder / name);
    parallel::set_threads(1);
    return read_manifest(folder / name)["state_hash"].get<std::string>();
  };
  const std::string even = hash_of("even", {}, 1), scattered = hash_of("scattered", {"joints.0.weibull_modulus=4.0"}, 1);
  EXPECT_NE(even, scattered);
  EXPECT_EQ(hash_of("two", {"joints.0.weibull_modulus=4.0"}, 2), scattered);
  EXPECT_NE(hash_of("seed", {"joints.0.weibull_modulus=4.0", "joints.0.scatter_seed=2"}, 1), scattered);
  const auto residual = [&](const std::string& name) {
    return std::abs(read_manifest(folder / name)["results"]["energy_residual"].get<Real>());
  };
  EXPECT_LT(residual("scattered"), 1.5 * residual("even"));  // of the contacts of this small block, about 0.3 % of the work
}

}  // namespace
}  // namespace sazare::runs
