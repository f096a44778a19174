#include "sazare/methods/blocks/run/blasting/holes_file.hpp"

#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "sazare/observe/csv_writer.hpp"

namespace sazare::runs {

namespace {

using Row = std::vector<observe::CsvField>;

Row row_of(const std::string& name, Real delay, const Vector3& first, const Vector3& last, Real diameter, Real mass) {
  Row row{name, delay};
  row.insert(row.end(), first.begin(), first.end());
  row.insert(row.end(), last.begin(), last.end());
  row.insert(row.end(), {diameter, mass});
  return row;
}

}  // namespace

void write_holes(const std::filesystem::path& file, const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh) {
  const auto map = geometry::build_face_map(mesh);
  const MeshFaces faces{mesh, map, geometry::find_surface_faces(mesh, map)};
  std::vector<Row> rows;
  for (const cases::Blast& blast : blocks.blasts) {
    const auto outer = faces.outer(blast.surface);
    if (outer.empty()) continue;
    const HoleWall wall = measure_wall(mesh, outer);
    if (wall.closes()) rows.push_back(row_of(blast.name, blast.delay, wall.first, wall.last, wall.diameter, 0));
  }
  for (std::size_t place = 0; place < blocks.charges.size(); ++place) {
    const cases::Charge& charge = blocks.charges[place];
    const Vector3 axis = (charge.toe - charge.collar).normalized();
    rows.push_back(row_of(charge.name, charge.firing_time(place), charge.collar + charge.top * axis,
                          charge.collar + charge.bottom_depth() * axis, charge.diameter,
                          charge.filling().density * charge.volume() / charge.share));
  }
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::blocks::holes);
  observe::write_csv(file, titles, rows);
}

}  // namespace sazare::runs
