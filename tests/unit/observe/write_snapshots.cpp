// Writes the snapshots that read_snapshots.py reads back.

#include <string>
#include <vector>

#include "sazare/observe/vtkhdf.hpp"

int main(int argc, char** argv) {
  using namespace sazare;
  if (argc < 2) return 2;
  const std::filesystem::path folder = argv[1];
  const std::vector<std::int32_t> tetrahedra = {0, 1, 2, 3, 1, 2, 3, 4};
  const std::vector<std::int32_t> triangles = {1, 2, 3};
  const std::vector<std::int32_t> levels = {3, -5};
  const std::vector<std::int32_t> states = {2};
  const std::vector<Real> velocities = {1, 2, 3, 4, 5, 1.0 / 3};
  observe::SnapshotSeries elements(folder, "elements");
  observe::SnapshotSeries joints(folder, "joints");
  for (int i = 0; i < 3; ++i) {
    const std::vector<Vector3> points = {{0, 0, 0}, {1.0 + i, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    elements.write({observe::Grid::Cell::tetrahedron,
                    points,
                    tetrahedra,
                    {{"level", 1, std::span<const std::int32_t>(levels)}, {"velocity", 3, std::span<const Real>(velocities)}},
                    i * 2.5e-5});
    joints.write(
        {observe::Grid::Cell::triangle, points, triangles, {{"state", 1, std::span<const std::int32_t>(states)}}, i * 2.5e-5});
  }
  observe::write_vtkhdf(folder / "empty.vtkhdf",
                        {observe::Grid::Cell::triangle, {}, {}, {{"state", 1, std::span<const std::int32_t>()}}, 0});
  return 0;
}
