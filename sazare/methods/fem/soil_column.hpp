#pragma once

/// Columns of level layers beside the sides of a body: which layers, on which base.

#include <stdexcept>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::methods::fem {

/// Layers of 1 m2 (in 2-D 1 m) whose motion depends on the elevation alone: elements are lines, from the bottom up.
template <int D>
struct SoilColumn {
  BodyDescription body;
  Supports<D> supports;
};

/// A side beside which no column can stand, and what to do about it.
class UnfitSide : public UserError {
public:
  UnfitSide(const std::string& what, std::string help) : UserError(what), help_(std::move(help)) {}
  const std::string& help() const { return help_; }

private:
  std::string help_;
};

/// Impedance of the ground beyond a face of an element.
template <int D>
ViscousFace viscous_face(const BodyDescription& body, Index element, const geometry::MeshElement& face);

/// The sides that the faces of a group make, one for each vertical plane across x or y, with columns of the layers beside them
/// that do not stand on anything yet. Columns have a node wherever the side has a corner of a face, and middles where the faces
/// have them. Throws UnfitSide.
template <int D>
std::vector<FreeFieldSide<D>> free_field_sides(const BodyDescription& body, const geometry::ElementGroup& group, Index boundary);

/// Gives the column the gravity and motions of the body, and holds it as all nodes of the side at the same elevation are held; at
/// its foot it stands on the viscous boundaries of the body that reach there. Throws UnfitSide where nothing carries its foot.
template <int D>
void stand_on_base(FreeFieldSide<D>& side, const Supports<D>& supports);

}  // namespace sazare::methods::fem
