#include <gtest/gtest.h>

#include <cmath>

#include "sazare/core/error.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/levels/terms/gravity.hpp"
#include "sazare/methods/blocks/contacts.hpp"
#include "sazare/methods/hybrid/block_side.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/two_sides.hpp"
#include "tests/support/window_checks.hpp"

namespace sazare::methods::hybrid {
namespace {

namespace blocks = methods::blocks;

/// A tetrahedron that stands on a face, thrown at the top of a box.
class TetrahedronOnTop {
public:
  TetrahedronOnTop(const test::CouplingScene& scene, Real window, bool can_return = true)
      : gravity_(scene.gravity), fem_(test::make_fem<3>(scene, window)) {
    const Real top = scene.box.size.z(), size = 0.1;
    const Vector3 low(0.14, 0.12, top + 5e-4);
    const geometry::Tetrahedron corners = {low, low + Vector3(size, 0, 0), low + Vector3(0, size, 0), low + Vector3(0, 0, size)};
    corners_.assign(corners.begin(), corners.end());
    state::Bodies<3> bodies = of(corners, 2000);
    bodies.motion[0].velocity = velocity_;
    const laws::SphereContact law{scene.stiffness, scene.restitution < 1 ? 50.0 : 0.0, scene.friction, laws::DampingCap::step};
    levels::TermList<3> terms;
    terms.push_back(std::make_unique<blocks::Joints>(std::vector<blocks::JointKind>{}, std::vector<blocks::JointFace>{},
                                                     std::vector<terms::Rates>(1), bodies));
    auto& joints = static_cast<blocks::Joints&>(*terms.back());
    std::vector<blocks::FreeFace> faces;
    for (int face = 0; face < 4; ++face) faces.push_back({0, face});
    terms.push_back(
        std::make_unique<blocks::Contacts>(law, 5, joints, geometry::ElementCorners{corners_, numbers_}, faces, bodies));
    auto& contacts = static_cast<blocks::Contacts&>(*terms.back());
    terms.push_back(std::make_unique<blocks::SurfaceContacts>(law, contacts, bodies));
    surface_ = static_cast<blocks::SurfaceContacts*>(terms.back().get());
    if (!gravity_.isZero()) terms.push_back(std::make_unique<terms::Gravity<3>>(gravity_, bodies));
    levels::StepRules rules;
    rules.base_step = window / static_cast<Real>(scene.steps);
    simulation_ = std::make_unique<levels::Simulation<3>>(std::move(bodies), std::move(terms), rules);
    bodies_ = std::make_unique<BlockSide>(*simulation_, *surface_, can_return);
    const auto& mesh = fem_->body().mesh();
    continuum_ = std::make_unique<ContinuumSide<3>>(*fem_, geometry::linear_surface(mesh, *mesh.find_group("top")), scene.rules);
  }

  void start() {
    fem_->start();
    DirectChannel channel(*bodies_);
    continuum_->start(channel.open(continuum_->shape()));
  }
  void advance(int windows) {
    DirectChannel channel(*bodies_);
    for (int window = 0; window < windows; ++window) continuum_->advance(channel);
  }
  void columns(Archive& archive) {
    archive.folder("fem", [&] { fem_->columns(archive); });
    archive.folder("continuum", [&] { continuum_->columns(archive); });
    if (archive.reading()) bodies_->attach(continuum_->shape());
    archive.folder("bodies", [&] { bodies_->columns(archive); });
    archive.folder("simulation", [&] { simulation_->columns(archive); });
  }
  Vector3 momentum() const { return mass() * simulation_->snapshot().velocity[0]; }
  Real mass() const { return simulation_->bodies().inertia[0].mass; }
  Vector3 weight() const { return mass() * gravity_; }

  fem::FemStepper<3>& fem() { return *fem_; }
  levels::Simulation<3>& simulation() { return *simulation_; }
  ContinuumSide<3>& continuum() { return *continuum_; }
  BlockSide& bodies() { return *bodies_; }

private:
  static state::Bodies<3> of(const geometry::Tetrahedron& corners, Real density) {
    state::Bodies<3> bodies;
    const Vector3 centre = geometry::centroid(corners);
    const Eigen::SelfAdjointEigenSolver<Matrix3> axes(density * geometry::inertia_about_centroid(corners));
    Matrix3 rotation = axes.eigenvectors();
    if (rotation.determinant() < 0) rotation.col(2) *= -1;
    Real reach = 0;
    for (const Vector3& corner : corners) reach = std::max(reach, (corner - centre).norm());
    state::add_body(bodies, density * geometry::volume(corners), centre, axes.eigenvalues(), Quaternion(rotation).normalized(),
                    reach);
    return bodies;
  }

  Vector3 velocity_{0.1, 0.05, -0.3}, gravity_;
  std::vector<Vector3> corners_;
  std::vector<std::array<std::int32_t, 4>> numbers_{{0, 1, 2, 3}};
  std::unique_ptr<fem::FemStepper<3>> fem_;
  blocks::SurfaceContacts* surface_ = nullptr;
  std::unique_ptr<levels::Simulation<3>> simulation_;
  std::unique_ptr<BlockSide> bodies_;
  std::unique_ptr<ContinuumSide<3>> continuum_;
};

test::CouplingScene thrown(CouplingScheme scheme) {
  test::CouplingScene scene;
  scene.shape = geometry::ElementShape::hexahedron8;
  scene.box = {{0.4, 0.4, 0.2}, {4, 4, 2}, 0};
  scene.youngs_modulus = 1e7;
  scene.held = scene.upright = scene.lumped = false;
  scene.stiffness = 1e5;
  scene.friction = 0.3;
  scene.restitution = 0.5;
  scene.rules.scheme = scheme;
  return scene;
}

TEST(block_side, nodes_get_the_momentum_that_blocks_lose) {
  for (const CouplingScheme scheme : {CouplingScheme::lagged, CouplingScheme::impulse, CouplingScheme::iterative}) {
    test::CouplingScene scene = thrown(scheme);
    scene.rules.tolerance = 1e-3;
    TetrahedronOnTop sides(scene, 1e-3);
    sides.start();
    const Vector3 before = sides.momentum();
    sides.advance(12);
    const Vector3 lost = before - sides.momentum();
    ASSERT_GT(sides.continuum().totals().given.norm(), 0.03);
    EXPECT_LT((lost - sides.continuum().totals().given).norm(), 1e-12 * lost.norm());
  }
}

TEST(block_side, the_energy_balance_of_the_blocks_has_the_work_of_the_surface) {
  test::CouplingScene scene = thrown(CouplingScheme::impulse);
  scene.steps = 200;
  TetrahedronOnTop sides(scene, 1e-3);
  sides.start();
  sides.advance(12);
  const terms::EnergyBalance balance = sides.simulation().energy_balance();
  EXPECT_NEAR(balance[terms::EnergyKind::work], sides.continuum().totals().energy_work_on_bodies, 1e-12);
  EXPECT_GT(std::abs(balance[terms::EnergyKind::work]), 1e-5);
  EXPECT_GT(balance[terms::EnergyKind::contact_dashpot], 0);
  EXPECT_GT(balance[terms::EnergyKind::friction], 0);
  EXPECT_NEAR(balance.residual(), 0, 1e-3 * std::abs(balance[terms::EnergyKind::kinetic]));
}

TEST(block_side, repeated_windows_make_no_energy) {
  test::CouplingScene scene = thrown(CouplingScheme::iterative);
  scene.rules.tolerance = 1e-8;
  scene.friction = 0;
  scene.restitution = 1;
  TetrahedronOnTop sides(scene, 2e-4);
  sides.start();
  sides.advance(60);
  const auto& totals = sides.continuum().totals();
  EXPECT_GT(totals.energy_work_on_nodes, 1e-5);
  EXPECT_LT(std::abs(totals.made()), 1e-6 * totals.energy_work_on_nodes);
  EXPECT_GT(totals.passes, totals.windows);
}

TEST(block_side, the_reaction_of_what_lies_still_is_its_weight) {
  test::CouplingScene scene = thrown(CouplingScheme::impulse);
  scene.held = scene.upright = true;
  scene.gravity = {0, 0, -9.81};
  scene.alpha = -0.3;
  scene.stiffness = 1e4;
  TetrahedronOnTop sides(scene, 1e-3);
  sides.start();
  sides.advance(6000);
  const Real weight = sides.weight().norm();
  EXPECT_NEAR((sides.continuum().mean_force() - sides.weight()).norm(), 0, 1e-6 * weight);
}

test::MemoryArchive after(CouplingScheme scheme, int windows) {
  test::CouplingScene scene = thrown(scheme);
  scene.rules.tolerance = 1e-3;
  TetrahedronOnTop sides(scene, 1e-3);
  sides.start();
  sides.advance(windows);
  test::MemoryArchive archive;
  sides.columns(archive);
  return archive;
}

TEST(block_side, goes_on_from_a_checkpoint_and_with_more_threads_as_if_nothing_had_been) {
  for (const CouplingScheme scheme : {CouplingScheme::impulse, CouplingScheme::iterative}) {
    auto checkpoint = after(scheme, 5);
    checkpoint.turn_round();
    test::CouplingScene scene = thrown(scheme);
    scene.rules.tolerance = 1e-3;
    TetrahedronOnTop resumed(scene, 1e-3);
    resumed.columns(checkpoint);
    resumed.advance(6);
    test::MemoryArchive archive;
    resumed.columns(archive);
    parallel::set_threads(2);
    const auto whole = after(scheme, 11);
    parallel::set_threads(1);
    EXPECT_TRUE(archive == whole);
  }
}

TEST(block_side, takes_a_window_back_and_refuses_what_it_cannot_do) {
  TetrahedronOnTop sides(thrown(CouplingScheme::impulse), 1e-3), once(thrown(CouplingScheme::impulse), 1e-3, false);
  test::expect_windows_can_be_taken_back(sides, once, 4);
}

}  // namespace
}  // namespace sazare::methods::hybrid
