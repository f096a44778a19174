#include "sazare/methods/hybrid/ground_side.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/mps/elastic_forces.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/two_sides.hpp"
#include "tests/support/window_checks.hpp"

namespace sazare::methods::hybrid {
namespace {

using mps::Site;

constexpr Real spacing = 0.05;

struct GroundScene {
  test::CouplingScene box;
  bool fails = false;   ///< ground without cohesion, which breaks where it hits
  bool damped = false;  ///< by Rayleigh damping, also in proportion to the mass
};

/// A block of ground, 4 by 3 (by 4) particles, that falls on the top of a box.
template <int D>
class GroundOnTop {
public:
  GroundOnTop(const GroundScene& scene, Real window, bool can_return = true)
      : scene_(scene), fem_(test::make_fem<D>(scene.box, window)) {
    const auto sites = make_sites();
    particles_ = make_particles(sites);
    auto links = mps::make_links<D>(sites, spacing, 1.5);
    particles::ParticleSupports<D> supports;
    supports.gravity = scene.box.gravity.head<D>();
    const Real step = window / static_cast<Real>(scene.box.steps);
    auto ground = std::make_unique<mps::GroundAtSurface<D>>(
        make_forces(links, step), failing_,
        std::vector<mps::WaveVelocities>(particles_.size(), {std::sqrt(3.5e5 / 1500), std::sqrt(1e5 / 1500)}),
        mps::SurfaceRules{step, 0.2, scene.box.friction});
    forces_ = ground.get();
    stepper_ = std::make_unique<particles::UniformStepper<D>>(
        particles_, std::move(ground), supports,
        particles::UniformRules{.step = step,
                                .damping = scene.damped ? laws::RayleighDamping::make(5, 50) : laws::RayleighDamping{}});
    side_ = std::make_unique<GroundSide<D>>(*stepper_, *forces_, can_return);
    const auto& mesh = fem_->body().mesh();
    continuum_ =
        std::make_unique<ContinuumSide<D>>(*fem_, geometry::linear_surface(mesh, *mesh.find_group("top")), scene.box.rules);
  }

  void start() {
    fem_->start();
    DirectChannel channel(*side_);
    continuum_->start(channel.open(continuum_->shape()));
  }
  void advance(int windows) {
    DirectChannel channel(*side_);
    for (int window = 0; window < windows; ++window) continuum_->advance(channel);
  }
  void columns(Archive& archive) {
    archive.folder("fem", [&] { fem_->columns(archive); });
    archive.folder("continuum", [&] { continuum_->columns(archive); });
    if (archive.reading()) side_->attach(continuum_->shape());
    archive.folder("side", [&] { side_->columns(archive); });
    archive.folder("stepper", [&] { stepper_->columns(archive); });
  }

  Vector3 momentum() const {
    Vector3 sum = Vector3::Zero();
    const auto velocity = stepper_->velocity();
    for (std::size_t i = 0; i < particles_.size(); ++i)
      for (std::size_t axis = 0; axis < D; ++axis) sum[static_cast<int>(axis)] += velocity[axis][i] / particles_.inverse_mass[i];
    return sum;
  }
  Real mass() const { return static_cast<Real>(particles_.size()) / particles_.inverse_mass[0]; }
  ContinuumSide<D>& continuum() { return *continuum_; }
  GroundSide<D>& bodies() { return *side_; }
  const mps::FailingForces<D>* failing() const { return failing_; }

private:
  static std::vector<Site<D>> make_sites() {
    std::vector<Site<D>> sites;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < (D == 3 ? 4 : 1); ++k)
        for (int j = 0; j < 3; ++j) {
          if constexpr (D == 2)
            sites.push_back({i, j});
          else
            sites.push_back({i, k, j});
        }
    return sites;
  }
  state::Particles<D> make_particles(const std::vector<Site<D>>& sites) const {
    constexpr Real density = 1500, shear_modulus = 1e5;
    state::Particles<D> particles;
    particles.spacing = spacing;
    particles.resize(static_cast<Index>(sites.size()));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      for (std::size_t axis = 0; axis < D; ++axis)
        particles.start[axis][i] = (sites[i][axis] + 0.5) * spacing + (axis + 1 == D ? 0 : 0.08);
      particles.start[D - 1][i] += scene_.box.box.size[D - 1] + 4e-4;
      particles.set_density(static_cast<Index>(i), density);
      particles.shear_modulus[i] = shear_modulus;
      particles.lame[i] = 1.5 * shear_modulus;
      particles.damping_ratio[i] = 0.2;
    }
    return particles;
  }
  std::unique_ptr<particles::ParticleForces<D>> make_forces(const mps::LinkTable<D>& links, Real step) {
    if (!scene_.fails) return std::make_unique<mps::ElasticForces<D>>(links, mps::RotationRemoval::mean_rotation);
    const mps::StrengthOfGround ground{true, laws::MohrCoulomb::make(50, 0.5, 0, 0.0), {1e5, 1.5e5}, 1500, 1e-3};
    auto failing = std::make_unique<mps::FailingForces<D>>(
        particles_, links, mps::GroundStrength<D>(particles_, links, {ground}, std::vector<Index>(particles_.size(), 0)),
        mps::LooseRules{.step = step, .damping_ratio = 0.2});
    failing_ = failing.get();
    return failing;
  }

  GroundScene scene_;
  std::unique_ptr<fem::FemStepper<D>> fem_;
  state::Particles<D> particles_;
  const mps::FailingForces<D>* failing_ = nullptr;
  mps::GroundAtSurface<D>* forces_ = nullptr;
  std::unique_ptr<particles::UniformStepper<D>> stepper_;
  std::unique_ptr<GroundSide<D>> side_;
  std::unique_ptr<ContinuumSide<D>> continuum_;
};

template <int D>
GroundScene fall(CouplingScheme scheme, bool fails) {
  GroundScene scene;
  scene.box.shape = D == 2 ? geometry::ElementShape::quadrilateral4 : geometry::ElementShape::hexahedron8;
  scene.box.box = {{0.4, D == 2 ? 0.2 : 0.4, 0.2}, {5, D == 2 ? 2 : 5, 2}, 0};
  scene.box.youngs_modulus = 1e7;
  scene.box.held = scene.box.upright = scene.box.lumped = false;
  scene.box.friction = 0.3;
  scene.box.gravity = D == 2 ? Vector3(2, -40, 0) : Vector3(2, 1, -40);
  scene.box.rules.width = 1;
  scene.box.rules.scheme = scheme;
  scene.fails = fails;
  return scene;
}

template <int D>
void expect_momentum_to_be_kept(bool fails) {
  for (const CouplingScheme scheme : {CouplingScheme::lagged, CouplingScheme::impulse, CouplingScheme::iterative}) {
    const GroundScene scene = fall<D>(scheme, fails);
    GroundOnTop<D> sides(scene, 1e-3);
    sides.start();
    const Vector3 before = sides.momentum();
    sides.advance(40);
    const Vector3 lost = before + 40e-3 * sides.mass() * scene.box.gravity - sides.momentum();
    ASSERT_GT(sides.continuum().totals().given.norm(), 0.5);
    EXPECT_LT((lost - sides.continuum().totals().given).norm(), 1e-10 * lost.norm());
    if (fails) {
      EXPECT_GT(sides.failing()->broken_links(), 0);
    }
  }
}

TEST(ground_side, nodes_get_the_momentum_that_ground_loses) {
  expect_momentum_to_be_kept<2>(false);
  expect_momentum_to_be_kept<2>(true);
  expect_momentum_to_be_kept<3>(false);
}

TEST(ground_side, the_reaction_of_ground_that_lies_still_is_its_weight) {
  GroundScene scene = fall<2>(CouplingScheme::impulse, false);
  scene.box.held = scene.box.upright = true;
  scene.box.alpha = -0.3;
  scene.box.gravity = {0, -9.81, 0};
  scene.box.friction = 1;
  scene.damped = true;
  GroundOnTop<2> sides(scene, 1e-3);
  sides.start();
  sides.advance(6000);
  const Real weight = 9.81 * sides.mass();
  EXPECT_NEAR(-sides.continuum().mean_force().y(), weight, 1e-3 * weight);
  EXPECT_NEAR(sides.continuum().mean_force().x(), 0, 1e-3 * weight);
}

template <int D>
test::MemoryArchive after(const GroundScene& scene, int windows) {
  GroundOnTop<D> sides(scene, 1e-3);
  sides.start();
  sides.advance(windows);
  test::MemoryArchive archive;
  sides.columns(archive);
  return archive;
}

template <int D>
void expect_the_same_bits(bool fails) {
  const GroundScene scene = fall<D>(CouplingScheme::iterative, fails);
  auto checkpoint = after<D>(scene, 20);
  checkpoint.turn_round();
  GroundOnTop<D> resumed(scene, 1e-3);
  resumed.columns(checkpoint);
  resumed.advance(20);
  test::MemoryArchive archive;
  resumed.columns(archive);
  parallel::set_threads(2);
  const auto whole = after<D>(scene, 40);
  parallel::set_threads(1);
  for (const auto& [name, bytes] : whole.columns()) EXPECT_TRUE(archive.columns().at(name) == bytes) << name;
  EXPECT_TRUE(archive == whole);
}

TEST(ground_side, goes_on_from_a_checkpoint_and_with_more_threads_as_if_nothing_had_been) {
  expect_the_same_bits<2>(false);
  expect_the_same_bits<2>(true);
  expect_the_same_bits<3>(false);
}

/// Ground that breaks in a window which is then taken back has its links again.
TEST(ground_side, takes_a_window_back_and_refuses_what_it_cannot_do) {
  for (const bool fails : {false, true}) {
    const GroundScene scene = fall<2>(CouplingScheme::impulse, fails);
    GroundOnTop<2> sides(scene, 1e-3), once(scene, 1e-3, false);
    test::expect_windows_can_be_taken_back(sides, once, 8);
    coupling::SurfaceShape shape = sides.continuum().shape();
    shape.dimension = 3;
    EXPECT_THROW(sides.bodies().attach(shape), UserError);
  }
}

TEST(ground_side, breaks_the_same_links_when_windows_are_repeated) {
  const GroundScene scene = fall<2>(CouplingScheme::impulse, true);
  GroundOnTop<2> sides(scene, 1e-3);
  sides.start();
  int window = 0;
  while (sides.failing()->broken_links() == 0 && window < 40) {
    sides.advance(1);
    ++window;
  }
  ASSERT_LT(window, 40);
  const Index broken = sides.failing()->broken_links();
  sides.bodies().take_back();
  EXPECT_EQ(sides.failing()->broken_links(), 0);
  const std::vector<Real> still(sides.continuum().shape().nodes.size(), 0);
  coupling::SurfaceMotion motion{window - 1, 0, 1e-3 * window, still, {}};
  sides.bodies().answer(motion);
  EXPECT_GE(sides.failing()->broken_links(), broken / 2);
}

}  // namespace
}  // namespace sazare::methods::hybrid
