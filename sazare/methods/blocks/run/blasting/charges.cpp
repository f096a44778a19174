#include "sazare/methods/blocks/run/blasting/charges.hpp"

#include <algorithm>
#include <numbers>

namespace sazare::runs {

namespace {

Real circle(Real diameter) { return std::numbers::pi / 4 * diameter * diameter; }

methods::blocks::AxialPart filled_part(const cases::Charge& charge) { return {charge.top, charge.bottom_depth()}; }

/// The part of the axis of a hole that a face stands along.
methods::blocks::AxialPart axial_part(const cases::Charge& charge, const std::array<Vector3, 3>& corners) {
  const Vector3 axis = (charge.toe - charge.collar).normalized();
  std::array<Real, 3> depths;
  for (std::size_t k = 0; k < 3; ++k) depths[k] = axis.dot(corners[k] - charge.collar);
  const auto [least, most] = std::ranges::minmax(depths);
  const Real flat = 1e-9 * charge.hole_length();
  return most - least > flat ? methods::blocks::AxialPart{least, most} : methods::blocks::AxialPart{least, least};
}

/// Whether a part has something in common with another one that has a length; the end of a hole counts as its face.
bool touches(const methods::blocks::AxialPart& face, const methods::blocks::AxialPart& filled) {
  const Real near = 1e-6 * filled.length();
  if (face.length() == 0) return filled.from - near <= face.from && face.from <= filled.to + near;
  return std::min(face.to, filled.to) - std::max(face.from, filled.from) > 0;
}

methods::blocks::GasInCracks gas_in_cracks(const cases::Charge& charge) {
  using Way = methods::blocks::GasInCracks;
  constexpr std::array ways = {Way::none, Way::share, Way::flow};
  return ways[static_cast<std::size_t>(charge.gas_in_cracks)];
}

/// A face of the mesh beside the explosive of a charge.
struct ChargedPlace {
  std::size_t charge;
  geometry::OuterFace face;
};

std::vector<ChargedPlace> charged_places(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::vector<ChargedPlace> found;
  for (std::size_t charge = 0; charge < blocks.charges.size(); ++charge)
    for (const geometry::OuterFace& face : faces.outer(blocks.charges[charge].surface))
      if (stands_along(blocks.charges[charge], face_corners(faces.mesh, face.nodes))) found.push_back({charge, face});
  return found;
}

}  // namespace

bool stands_along(const cases::Charge& charge, const std::array<Vector3, 3>& corners) {
  return touches(axial_part(charge, corners), filled_part(charge));
}

Real covered_share(const cases::Charge& charge, const std::array<Vector3, 3>& corners) {
  return axial_part(charge, corners).covered_by(filled_part(charge));
}

std::vector<methods::blocks::Charge> make_charges(const cases::BlocksCase& blocks) {
  std::vector<methods::blocks::Charge> made;
  for (std::size_t place = 0; place < blocks.charges.size(); ++place) {
    const cases::Charge& charge = blocks.charges[place];
    const laws::Explosive filling = charge.filling();
    const Real hole = charge.share * circle(charge.diameter);
    made.push_back(
        {.gas = filling.gas,
         .energy = filling.energy,
         .density = filling.density,
         .velocity = filling.velocity,
         .area = charge.share * circle(charge.explosive_diameter()),
         .hole_area = hole,
         .collar = {charge.vents, hole, charge.diameter, charge.top, charge.stemming_density, charge.stemming_resistance},
         .cracks = {gas_in_cracks(charge), charge.crack_pressure_share, charge.crack_aperture, charge.discharge_coefficient},
         .filled = filled_part(charge),
         .primer = charge.primer_depth(),
         .delay = charge.firing_time(place),
         .cut_distance = charge.cut_distance});
  }
  return made;
}

std::vector<methods::blocks::ChargedFace> make_charged_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                             const state::Bodies<3>& bodies) {
  std::vector<methods::blocks::ChargedFace> made;
  for (const ChargedPlace& place : charged_places(blocks, faces)) {
    const cases::Charge& charge = blocks.charges[place.charge];
    const methods::blocks::AxialPart filled = filled_part(charge);
    const auto corners = face_corners(faces.mesh, place.face.nodes);
    methods::blocks::ChargedFace face;
    face.part = axial_part(charge, corners);
    if (face.part.length() == 0) face.part.from = face.part.to = std::clamp(face.part.from, filled.from, filled.to);
    const CarriedFace carried = carried_face(bodies, place.face.element, corners);
    face.area = carried.area;
    face.centre = carried.centre;
    face.start = carried.start;
    face.body = place.face.element;
    face.charge = static_cast<Index>(place.charge);
    made.push_back(face);
  }
  return made;
}

bool has_gas_in_cracks(const cases::BlocksCase& blocks) {
  return std::ranges::any_of(blocks.charges,
                             [](const cases::Charge& charge) { return charge.gas_in_cracks != cases::GasInCracks::none; });
}

methods::blocks::GasFaces make_gas_faces(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  methods::blocks::GasFaces made{faces.mesh.nodes, faces.map.interior, {}};
  std::vector<bool> is_free(faces.map.outer.size(), true);
  for (std::size_t surface = 0; surface < faces.surfaces.size(); ++surface) {
    const std::string& name = faces.mesh.surfaces[surface].name;
    const auto stands_on = [&](const auto& entry) { return entry.surface == name; };
    if (std::ranges::any_of(blocks.charges, stands_on) || std::ranges::any_of(blocks.boundaries, stands_on))
      for (const Index face : faces.surfaces[surface].outer) is_free[at(face)] = false;
  }
  for (std::size_t face = 0; face < is_free.size(); ++face)
    if (is_free[face]) made.outer.push_back({faces.map.outer[face].nodes});
  Index number = 0;
  for (const ChargedPlace& place : charged_places(blocks, faces)) made.outer.push_back({place.face.nodes, number++});
  return made;
}

}  // namespace sazare::runs
