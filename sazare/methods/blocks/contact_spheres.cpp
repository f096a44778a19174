#include "sazare/methods/blocks/contact_spheres.hpp"

#include <algorithm>
#include <limits>

namespace sazare::methods::blocks {

namespace {

Real tangent_radius(const geometry::Tetrahedron& corners, int face, const Vector3& point) {
  const Vector3 normal = geometry::outward_normal(corners, face);
  Real radius = std::numeric_limits<Real>::infinity();
  for (int other = 0; other < 4; ++other) {
    if (other == face) continue;
    const Vector3 other_normal = geometry::outward_normal(corners, other);
    const Real distance = other_normal.dot(corners[static_cast<std::size_t>(face)] - point);  // corner `face` lies on it
    radius = std::min(radius, distance / (1 - normal.dot(other_normal)));
  }
  return radius;
}

}  // namespace

std::vector<ContactSphere> contact_spheres(const geometry::Tetrahedron& corners, int face, int edge_division) {
  const auto& [a, b, c] = geometry::tetrahedron_faces[static_cast<std::size_t>(face)];
  const Vector3 normal = geometry::outward_normal(corners, face);
  std::vector<ContactSphere> spheres;
  for (int i = 1; i < edge_division - 1; ++i)
    for (int j = 1; j < edge_division - i; ++j) {
      const int k = edge_division - i - j;
      const Vector3 point = (i * corners[static_cast<std::size_t>(a)] + j * corners[static_cast<std::size_t>(b)] +
                             k * corners[static_cast<std::size_t>(c)]) /
                            edge_division;
      const Real radius = tangent_radius(corners, face, point);
      spheres.push_back({point - radius * normal, radius});
    }
  return spheres;
}

ContactSphere bounding_sphere(const std::vector<ContactSphere>& spheres) {
  ContactSphere bound{Vector3::Zero(), 0};
  for (const ContactSphere& sphere : spheres) bound.centre += sphere.centre / static_cast<Real>(spheres.size());
  for (const ContactSphere& sphere : spheres)
    bound.radius = std::max(bound.radius, (sphere.centre - bound.centre).norm() + sphere.radius);
  return bound;
}

}  // namespace sazare::methods::blocks
