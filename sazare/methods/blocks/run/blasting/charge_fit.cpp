#include "sazare/methods/blocks/run/blasting/charge_fit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/run/blasting/charges.hpp"

namespace sazare::runs {

namespace {

/// Whether a face stands across the axis of a hole, at its end.
bool is_end(const Vector3& axis, const Vector3& area) { return axis.cross(area).norm() < 0.5 * area.norm(); }

ChargeFit fit_of(const cases::Charge& charge, const MeshFaces& faces) {
  ChargeFit fit;
  const Vector3 axis = (charge.toe - charge.collar).normalized();
  Real widths = 0;
  Index of_mantle = 0;
  for (const geometry::OuterFace& face : faces.outer(charge.surface)) {
    const auto corners = face_corners(faces.mesh, face.nodes);
    if (!stands_along(charge, corners)) continue;
    ++fit.faces;
    for (const Vector3& corner : corners) fit.distance += axis.cross(corner - charge.collar).norm() / 3;
    if (is_end(axis, area_vector(corners))) continue;
    widths += width_around(axis, corners);
    ++of_mantle;
    fit.area += covered_share(charge, corners) * area_vector(corners).norm();
  }
  if (fit.faces > 0) fit.distance /= fit.faces;
  if (widths > 0) fit.around = std::numbers::pi * charge.diameter * of_mantle / widths;
  return fit;
}

}  // namespace

std::vector<ChargeFit> find_charge_fits(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::vector<ChargeFit> fits;
  for (const cases::Charge& charge : blocks.charges) fits.push_back(fit_of(charge, faces));
  return fits;
}

std::string warn_of_charges(const cases::CaseFile& file, const std::vector<ChargeFit>& fits) {
  constexpr Real most_off = 0.15;  // of the radius
  constexpr Real elsewhere = 2;    // diameters
  const auto& charges = file.as<cases::BlocksCase>().charges;
  const auto number = [](Real value) { return cases::short_number(value, 4); };
  std::string all;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const cases::Charge& charge = charges[i];
    const std::string key = fmt::format("charges.{}", i);
    if (fits[i].faces == 0)
      refuse(file, key + ".surface",
             fmt::format("no face of \"{}\" stands beside the explosive, {} to {} m below the collar", charge.surface,
                         number(charge.top), number(charge.bottom_depth())),
             "is the collar at the right end, and is this the wall of that hole?");
    const Real radius = charge.diameter / 2;
    if (fits[i].distance > elsewhere * charge.diameter)
      refuse(file, key + ".collar",
             fmt::format("the hole meets no wall: the corners of \"{}\" are {} m from its axis, and it is {} m across",
                         charge.surface, number(fits[i].distance), number(charge.diameter)),
             "collar and toe are in m, in the coordinates of the mesh; is this the wall of that hole?");
    if (std::abs(fits[i].distance - radius) > most_off * radius)
      all += warning(file, key + ".diameter",
                     fmt::format("the corners of the wall are {} m from the axis of the hole, whose radius is {} m",
                                 number(fits[i].distance), number(radius)),
                     "the gas presses on the wall of the mesh and has the room of the diameter: make the two agree");
    const Real area = std::numbers::pi * charge.diameter * (charge.bottom_depth() - charge.top) * charge.share;
    if (std::abs(fits[i].area - area) > most_off * area)
      all += warning(
          file, key + ".surface",
          fmt::format("the mesh has {} m2 of wall around the explosive, where a hole of this diameter and length has {} m2",
                      number(fits[i].area), number(area)),
          "does the charge reach beyond the hole of the mesh, or has the mesh but a part of the hole, which share tells?");
    if (fits[i].is_coarse())
      all += warning(file, key + ".surface", fmt::format("the hole has about {:.0f} faces around", fits[i].around),
                     "use eight or more, so that the gas presses evenly: mesh the wall of the hole more finely");
  }
  return all;
}

}  // namespace sazare::runs
