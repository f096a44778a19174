/// Mean stress of elements, as it is written: where the stress is uniform it is exact.

#include "sazare/methods/blocks/run/joints/element_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/geometry/face_map.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/box_of_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

constexpr Real density = 2500, youngs_modulus = 10e9, size = 0.3;

/// A cube of blocks whose inner corners are moved a little; its lower and upper sides are "bottom" and "top", the others "sides".
geometry::TetraMesh cube(int across) {
  geometry::TetraMesh mesh;
  const auto inner = [](Real x) { return x > 0.01 && x < size - 0.01 ? 1.0 : 0.0; };
  const auto move = [&](const Vector3& at) -> Vector3 {
    return 0.01 * Vector3(inner(at.x()) * std::sin(91 * at.y() + 40 * at.z()), inner(at.y()) * std::cos(77 * at.x()),
                          inner(at.z()) * std::sin(83 * at.x() + 50 * at.y()));
  };
  test::add_box(mesh, {"rock", Vector3::Zero(), {across, across, across}, size / across}, move);
  mesh.surfaces = {{"bottom", {}}, {"top", {}}, {"sides", {}}};
  for (const geometry::OuterFace& outer : geometry::build_face_map(mesh).outer) {
    const auto lie_at = [&](Real height) {
      return std::ranges::all_of(outer.nodes, [&](Index node) { return std::abs(mesh.nodes[at(node)].z() - height) < 1e-9; });
    };
    mesh.surfaces[lie_at(0) ? 0 : lie_at(size) ? 1 : 2].triangles.push_back(outer.nodes);
  }
  return mesh;
}

/// Elements with at most so many faces without a joint.
std::vector<std::size_t> with_open_faces(const runs::BlocksModel& model, int most) {
  std::vector<std::size_t> found;
  for (std::size_t element = 0; element < model.mesh.tetrahedra.size(); ++element) {
    int open = 0;
    for (int face = 0; face < 4; ++face) open += model.joints->joint_at(static_cast<Index>(element), face) < 0 ? 1 : 0;
    if (open <= most) found.push_back(element);
  }
  return found;
}

TEST(element_stress, is_the_initial_stress_while_nothing_moves) {
  auto blocks = test::elastic_rock(density, youngs_modulus, 0.2);
  blocks.initial_stress.normal = {-30e6, -10e6, 5e6};
  blocks.initial_stress.shear = {4e6, -3e6, 2e6};
  blocks.boundaries = {
      {"bottom", cases::BoundaryKind::fixed}, {"top", cases::BoundaryKind::fixed}, {"sides", cases::BoundaryKind::fixed}};
  auto model = runs::build_blocks(blocks, cube(3));
  model.simulation->start();
  const auto elements = with_open_faces(model, 1);
  EXPECT_GT(elements.size(), 100u);
  for (const int steps : {0, 20}) {
    test::run(model, steps);
    const runs::ElementStresses now = runs::element_stresses(model, model.simulation->snapshot());
    for (const std::size_t element : elements) {
      EXPECT_LT((now.normal[element] - blocks.initial_stress.normal).norm(), 1e-5 * 30e6) << element;
      EXPECT_LT((now.shear[element] - blocks.initial_stress.shear).norm(), 1e-5 * 30e6) << element;
      // By its invariants: 3 J2 = ((xx - yy)^2 + ...)/2 + 3 (xy^2 + ...).
      EXPECT_NEAR(now.von_mises[element], std::sqrt((400e12 + 225e12 + 1225e12) / 2 + 3 * 29e12), 1e-4 * 30e6);
      EXPECT_NEAR(now.smallest[element], -30.95007e6, 1e-5 * 30e6);  // eigenvalues by numpy
      EXPECT_NEAR(now.largest[element], 5.62004e6, 1e-5 * 30e6);
    }
  }
}

TEST(element_stress, of_a_pressed_cube_is_the_pressure_in_the_mean) {
  auto blocks = test::elastic_rock(density, youngs_modulus, 0.2);
  blocks.joints.front().damping_ratio = 0.5;
  const Real pressure = 1e6, end = 4e-3;
  cases::Blast load;
  load.name = load.surface = "top";
  load.pressure = cases::PressureTable{{}, {0, end}, {0, pressure}};
  blocks.blasts = {load};
  blocks.boundaries = {{"bottom", cases::BoundaryKind::frictionless}};
  auto model = runs::build_blocks(blocks, cube(4));
  model.simulation->start();
  while (model.simulation->now().seconds() < end) model.simulation->advance();
  const runs::ElementStresses now = runs::element_stresses(model, model.simulation->snapshot());
  Vector3 normal = Vector3::Zero(), shear = Vector3::Zero();
  Real volume = 0;
  for (const std::size_t element : with_open_faces(model, 4)) {
    const Real own = geometry::volume(geometry::corners_of(model.mesh, static_cast<Index>(element)));
    normal += own * now.normal[element];
    shear += own * now.shear[element];
    volume += own;
  }
  EXPECT_NEAR(normal.z() / volume, -pressure, 0.03 * pressure);
  EXPECT_NEAR(normal.x() / volume, 0, 0.03 * pressure);
  EXPECT_NEAR(normal.y() / volume, 0, 0.03 * pressure);
  EXPECT_LT(shear.norm() / volume, 0.03 * pressure);
}

}  // namespace
}  // namespace sazare::methods::blocks
