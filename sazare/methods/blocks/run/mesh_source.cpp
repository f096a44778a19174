#include "sazare/methods/blocks/run/mesh_source.hpp"

#include <set>

#include "sazare/geometry/element_order.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/geometry/gmsh/mesher.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/methods/blocks/case/mesh_check.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

namespace {

std::vector<std::string> regions_behind(const geometry::TetraMesh& mesh, const geometry::FaceMap& faces,
                                        const geometry::SurfaceFaces& surface) {
  std::set<std::int32_t> regions;
  for (const std::int32_t face : surface.outer)
    regions.insert(mesh.region[static_cast<std::size_t>(faces.outer[static_cast<std::size_t>(face)].element)]);
  std::vector<std::string> names;
  for (const std::int32_t region : regions) names.push_back(mesh.region_names[static_cast<std::size_t>(region)]);
  return names;
}

Vector3 area_of(const geometry::TetraMesh& mesh, const geometry::FaceMap& faces, const geometry::SurfaceFaces& surface) {
  Vector3 sum = Vector3::Zero();
  for (const std::int32_t face : surface.outer) {
    const auto& nodes = faces.outer[static_cast<std::size_t>(face)].nodes;
    const auto place = [&](std::size_t corner) { return mesh.nodes[static_cast<std::size_t>(nodes[corner])]; };
    const Vector3 twice = (place(1) - place(0)).cross(place(2) - place(0));
    sum += 0.5 * twice.cwiseAbs();
  }
  return sum;
}

cases::MeshGroups groups_of(const geometry::TetraMesh& mesh) {
  cases::MeshGroups groups{mesh.region_names, {}};
  const geometry::FaceMap faces = geometry::build_face_map(mesh);
  const auto surfaces = geometry::find_surface_faces(mesh, faces);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    groups.surfaces.push_back({mesh.surfaces[i].name, static_cast<long>(surfaces[i].outer.size()),
                               static_cast<long>(surfaces[i].interior.size()), regions_behind(mesh, faces, surfaces[i]),
                               area_of(mesh, faces, surfaces[i])});
  return groups;
}

}  // namespace

geometry::TetraMesh load_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep) {
  const cases::Mesh& mesh = file.as<cases::BlocksCase>().mesh;
  if (mesh.is_geometry() && !(keep && std::filesystem::exists(made)))
    geometry::mesh_geometry({mesh.file, made, mesh.parameters, mesh.size_factor});
  geometry::TetraMesh loaded = geometry::read_gmsh(mesh.is_geometry() ? made : mesh.file, mesh.scale);
  check_against_mesh(file, groups_of(loaded));
  geometry::sort_along_curve(loaded);
  return loaded;
}

}  // namespace sazare::runs
