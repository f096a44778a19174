#include "sazare/methods/blocks/case/mesh_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/format/case_text.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/methods/blocks/case/checks.hpp"
#include "sazare/methods/blocks/case/fields.hpp"
#include "sazare/methods/blocks/case/format.hpp"

namespace sazare::cases {
namespace {

class MeshCheck {
public:
  MeshCheck(const CaseFile& file, const MeshGroups& groups, Problems& problems)
      : blocks_(file.as<BlocksCase>()), groups_(groups), context_{file.text->root, blocks_schema(), {}, problems} {
    for (const MeshSurface& surface : groups.surfaces) surface_names_.push_back(surface.name);
  }

  void run() {
    check_regions("materials", blocks_.materials);
    check_regions("constraints", blocks_.constraints);
    check_regions("initial_velocities", blocks_.initial_velocities);
    check_every_region_has_material();
    check_joints();
    check_outer_surfaces("blasts", blocks_.blasts, "pressure acts on the outside of the body");
    check_outer_surfaces("charges", blocks_.charges, "gas presses on the outside of the body, the wall of a hole");
    check_outer_surfaces("boundaries", blocks_.boundaries, "boundaries are on the outside of the body");
    check_grounds();
    check_that_gravity_is_carried();
  }

private:
  template <class Item>
  void check_regions(std::string_view table, const std::vector<Item>& items) {
    const auto list = context_.entries_of(table);
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t k = 0; k < items[i].regions.size(); ++k) {
        const std::string& name = items[i].regions[k];
        if (std::ranges::find(groups_.regions, name) != groups_.regions.end()) continue;
        context_.problems.error(list[i].place("regions", k), fmt::format("the mesh has no region \"{}\"", name),
                                full_suggestion(name, groups_.regions, "regions (physical volume groups)"));
      }
    }
  }

  void check_every_region_has_material() {
    for (const std::string& region : groups_.regions) {
      const auto owns = [&](const Material& material) {
        return std::ranges::find(material.regions, region) != material.regions.end();
      };
      if (std::ranges::any_of(blocks_.materials, owns)) continue;
      context_.problems.error(context_.entries_of("materials").front().header(),
                              fmt::format("region \"{}\" of the mesh has no material", region),
                              "add it to the regions of one of the [[materials]]");
    }
  }

  const MeshSurface* find_surface(const Entry& entry, const std::string& name) {
    const auto found = std::ranges::find(groups_.surfaces, name, &MeshSurface::name);
    if (found == groups_.surfaces.end()) {
      context_.problems.error(entry.place("surface"), fmt::format("the mesh has no surface \"{}\"", name),
                              full_suggestion(name, surface_names_, "surfaces (physical surface groups)"));
      return nullptr;
    }
    if (found->outer_faces + found->inner_faces > 0) return &*found;
    context_.problems.error(entry.place("surface"), fmt::format("surface \"{}\" of the mesh has no faces", name),
                            "is the physical group in the .geo file empty, or were its triangles not saved?");
    return nullptr;
  }

  void check_joints() {
    const auto list = context_.entries_of("joints");
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Joint& joint = blocks_.joints[i];
      const MeshSurface* surface = joint.on_surface() ? find_surface(list[i], joint.surface) : nullptr;
      if (surface == nullptr || surface->inner_faces > 0) continue;
      context_.problems.error(list[i].place("surface"),
                              fmt::format("surface \"{}\" lies on the outside of the body", joint.surface),
                              "a joint needs an element on both sides; embed the surface in the volume");
    }
  }

  template <class Item>
  void check_outer_surfaces(std::string_view table, const std::vector<Item>& items, const std::string& reason) {
    const auto list = context_.entries_of(table);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const MeshSurface* surface = find_surface(list[i], items[i].surface);
      if (surface == nullptr || surface->outer_faces > 0) continue;
      context_.problems.error(list[i].place("surface"), fmt::format("surface \"{}\" lies inside the body", items[i].surface),
                              reason);
    }
  }

  /// The ground behind a boundary is like the element that stands on it: it has the joint of that material with itself.
  void check_grounds() {
    const auto list = context_.entries_of("boundaries");
    for (std::size_t i = 0; i < list.size(); ++i)
      for (const MeshSurface& surface : groups_.surfaces)
        if (surface.name == blocks_.boundaries[i].surface) {
          check_ground(list[i], surface);
          check_that_motions_act(list[i], blocks_.boundaries[i], surface);
        }
  }

  /// A frictionless face follows the part of a motion along its normal alone.
  void check_that_motions_act(const Entry& entry, const Boundary& boundary, const MeshSurface& surface) {
    if (boundary.kind != BoundaryKind::frictionless) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (boundary.motion[axis].empty() || surface.area[static_cast<int>(axis)] >= 1e-6 * surface.area.norm()) continue;
      context_.problems.error(entry.place(motion_name_keys[axis]),
                              fmt::format("frictionless faces along {} do not follow this motion", "xyz"[axis]),
                              "make the boundary \"prescribed\", or let it move along its normal");
    }
  }

  void check_ground(const Entry& entry, const MeshSurface& surface) {
    for (const Material& material : blocks_.materials) {
      const auto is_behind = [&](const std::string& region) {
        return std::ranges::find(surface.regions, region) != surface.regions.end();
      };
      const auto joins_itself = [&](const Joint& joint) {
        return joint.bonded && !joint.on_surface() && joint.between[0] == material.name && joint.between[1] == material.name;
      };
      if (std::ranges::none_of(material.regions, is_behind) || std::ranges::any_of(blocks_.joints, joins_itself)) continue;
      context_.problems.error(
          entry.place("surface"),
          fmt::format("the ground behind \"{0}\" has the material \"{1}\", and \"{1}\" has no joint with itself",
                      surface.name, material.name),
          fmt::format("add [[joints]] with between = [\"{0}\", \"{0}\"]", material.name));
    }
  }

  /// An absorbing face has dashpots alone: under gravity it yields for ever, unless it carries an initial stress.
  void check_that_gravity_is_carried() {
    const auto absorbs = [](const Boundary& boundary) { return boundary.kind == BoundaryKind::absorbing; };
    const auto found = std::ranges::find_if(blocks_.boundaries, absorbs);
    const auto carries = [&](const Boundary& boundary) { return this->carries(boundary); };
    const auto holds = [&](const Constraint& constraint) {
      for (int axis = 0; axis < 3; ++axis)
        if (constraint.translation[static_cast<std::size_t>(axis)] && blocks_.gravity.acceleration[axis] != 0) return true;
      return false;
    };
    if (blocks_.gravity.acceleration.isZero() || !blocks_.initial_stress.is_zero() || blocks_.settles() ||
        found == blocks_.boundaries.end() || std::ranges::any_of(blocks_.boundaries, carries) ||
        std::ranges::any_of(blocks_.constraints, holds))
      return;
    const auto entry = context_.entries_of("boundaries")[static_cast<std::size_t>(found - blocks_.boundaries.begin())];
    context_.problems.error(entry.place("kind"),
                            "under gravity an absorbing boundary yields without limit, and nothing else holds the body",
                            "add settle = true to [gravity]: the boundary then carries its reactions in equilibrium; or make the "
                            "boundary beneath the body "
                            "\"fixed\" or \"frictionless\", hold a region with [[constraints]], give the ground its "
                            "[initial_stress], which absorbing "
                            "boundaries carry, or remove [gravity]");
  }

  /// Whether a boundary has springs against gravity.
  bool carries(const Boundary& boundary) const {
    if (boundary.kind != BoundaryKind::frictionless) return boundary.holds_all_axes();
    const auto surface = std::ranges::find(groups_.surfaces, boundary.surface, &MeshSurface::name);
    if (surface == groups_.surfaces.end()) return false;
    const Vector3& gravity = blocks_.gravity.acceleration;
    return surface->area.dot(gravity.cwiseAbs()) > 1e-6 * surface->area.norm() * gravity.norm();
  }

  const BlocksCase& blocks_;
  const MeshGroups& groups_;
  CheckContext context_;
  std::vector<std::string> surface_names_;
};

}  // namespace

void check_against_mesh(const CaseFile& file, const MeshGroups& groups) {
  Problems problems = file.text->problems;
  MeshCheck(file, groups, problems).run();
  problems.throw_if_errors();
}

}  // namespace sazare::cases
