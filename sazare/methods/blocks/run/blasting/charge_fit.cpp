#include "sazare/methods/blocks/run/blasting/charge_fit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/run/blasting/charges.hpp"

namespace sazare::runs {

std::vector<ChargeFit> find_charge_fits(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::vector<ChargeFit> fits;
  for (const cases::Charge& charge : blocks.charges) {
    ChargeFit& fit = fits.emplace_back();
    const auto outer = faces.outer(charge.surface);
    if (!outer.empty()) fit.wall = measure_wall(faces.mesh, outer);
    const Vector3 axis = (charge.toe - charge.collar).normalized();
    for (const geometry::OuterFace& face : outer) {
      const auto corners = face_corners(faces.mesh, face.nodes);
      if (!stands_along(charge, corners)) continue;
      ++fit.faces;
      for (const Vector3& corner : corners) fit.distance += axis.cross(corner - charge.collar).norm() / 3;
    }
    if (fit.faces > 0) fit.distance /= fit.faces;
  }
  return fits;
}

std::string warn_of_charges(const cases::CaseFile& file, const std::vector<ChargeFit>& fits) {
  constexpr Real most_off = 0.15;  // of the radius
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
    if (std::abs(fits[i].distance - radius) > most_off * radius)
      all += warning(file, key + ".diameter",
                     fmt::format("the corners of the wall are {} m from the axis of the hole, whose radius is {} m",
                                 number(fits[i].distance), number(radius)),
                     "the gas presses on the wall of the mesh and has the room of the diameter: make the two agree");
    const Real around = fits[i].wall.around(charge.diameter);
    if (fits[i].wall.has_axis() && around < HoleWall::few_faces)
      all += warning(file, key + ".surface", fmt::format("the hole has about {:.0f} faces around", around),
                     "use eight or more, so that the gas presses evenly: mesh the wall of the hole more finely");
  }
  return all;
}

}  // namespace sazare::runs
