#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/water/checks.hpp"
#include "sazare/methods/spheres/case/fields.hpp"
#include "sazare/methods/spheres/case/format.hpp"

namespace sazare::cases {
namespace {

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

/// Reports a name that is not among those that exist.
void check_known(const CheckContext& context, const Entry& entry, std::string_view key, const Place& place,
                 const std::string& name, const std::vector<std::string>& names, std::string_view what) {
  if (!entry.gives(key) || std::ranges::find(names, name) != names.end()) return;
  context.problems.error(place, fmt::format("there is no {} \"{}\"", what, name),
                         full_suggestion(name, names, fmt::format("{}s", what)));
}

void check_box(const CheckContext& context, const Entry& entry, const Vector3& lower, const Vector3& upper,
               const std::array<bool, 3>& axes = {true, true, true}) {
  if (!entry.gives("lower") || !entry.gives("upper")) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (axes[axis] && !(upper[static_cast<int>(axis)] > lower[static_cast<int>(axis)]))
      context.problems.error(entry.place("upper"), fmt::format("upper must be above lower on the axis {}", "xyz"[axis]),
                             "lower is the corner with the smallest coordinates");
}

void check_domain(const CheckContext& context, const Domain& domain) {
  const Entry entry = context.entries_of("domain").front();
  const auto& axes = domain.periodic;
  if (axes[0] || axes[1] || axes[2]) check_keys(context, entry, "a periodic axis", {"lower", "upper"}, {});
  check_box(context, entry, domain.lower, domain.upper, axes);
}

std::string law_text(ContactModel model) {
  return fmt::format("model {}", laws::contact_law_words.at(static_cast<std::size_t>(model)));
}

/// The parameters that a contact law takes, or those that others take.
std::vector<std::string_view> law_keys(ContactModel model, bool own) {
  return laws::visit_law(model, [&]<class Law>(Law) {
    std::vector<std::string_view> keys;
    for (const laws::LawParameter& parameter : laws::law_parameters)
      if (laws::takes<Law>(parameter.name) == own) keys.push_back(parameter.name);
    return keys;
  });
}

void check_materials(const CheckContext& context, const SpheresCase& spheres) {
  const ContactModel model = spheres.contact.model;
  const bool needs_elasticity = laws::visit_law(model, []<class Law>(Law) { return Law::needs_elasticity; });
  for (const Entry& entry : context.entries_of("materials"))
    if (needs_elasticity) check_keys(context, entry, law_text(model), {"youngs_modulus", "poisson_ratio"}, {});
  const Entry contact = context.entries_of("contact").front();
  check_keys(context, contact, law_text(model), {}, law_keys(model, false));
  if (contact.has("friction_coefficient") && contact.has("friction_angle"))
    context.problems.error(contact.place("friction_angle"), "friction_coefficient and friction_angle are both given",
                           "keep one of them");
  if (contact.exists() && !contact.has("friction_coefficient") && !contact.has("friction_angle"))
    context.problems.error(contact.header(), "[contact] has neither friction_coefficient nor friction_angle",
                           "add friction_coefficient = ...; 0.0 is for contacts without friction");
}

void check_pairs(const CheckContext& context, const SpheresCase& spheres) {
  const auto names = names_of(spheres.materials);
  const auto list = context.entries_of("pairs");
  std::set<std::array<std::string, 2>> seen;
  for (std::size_t i = 0; i < list.size() && i < spheres.pairs.size(); ++i) {
    check_keys(context, list[i], law_text(spheres.contact.model), {}, law_keys(spheres.contact.model, false));
    auto between = spheres.pairs[i].between;
    for (std::size_t k = 0; k < 2; ++k)
      check_known(context, list[i], "between", list[i].place("between", k), between[k], names, "material");
    std::ranges::sort(between);
    if (list[i].gives("between") && !seen.insert(between).second)
      context.problems.error(list[i].place("between"),
                             fmt::format("the pair \"{}\" and \"{}\" stands twice", between[0], between[1]),
                             "keep one of them; the order of the two does not matter");
  }
}

/// What the contact law takes of every pair of materials that there is.
void check_law_parameters(const CheckContext& context, const SpheresCase& spheres) {
  const Entry contact = context.entries_of("contact").front();
  for (const std::string_view key : law_keys(spheres.contact.model, true)) {
    if (!contact.exists() || contact.has(key)) continue;
    const auto list = context.entries_of("pairs");
    const std::size_t kinds = spheres.materials.size();
    const auto given = std::ranges::count_if(list, [&](const Entry& entry) { return entry.has(key); });
    if (static_cast<std::size_t>(given) < kinds * (kinds + 1) / 2)
      context.problems.error(contact.header(),
                             fmt::format("[contact] has no \"{}\", which {} needs", key, law_text(spheres.contact.model)),
                             how_to_add(*find_key(*contact.table, key)));
  }
}

void check_shapes(const CheckContext& context, const SpheresCase& spheres) {
  const auto list = context.entries_of("shapes");
  for (std::size_t i = 0; i < list.size() && i < spheres.shapes.size(); ++i) {
    const Entry& entry = list[i];
    if (!entry.exists() || !entry.is_sound("source")) continue;
    const ClumpSource source = spheres.shapes[i].source;
    if (source == ClumpSource::tetrapod)
      check_keys(context, entry, "a tetrapod", {"height"}, {"file", "scale", "count"});
    else if (source == ClumpSource::file)
      check_keys(context, entry, "a file", {"file"}, {"height", "leg_spheres", "count"});
    else
      check_keys(context, entry, "a mesh", {"file"}, {"height", "leg_spheres"});
    check_known(context, entry, "bonds", entry.place("bonds"), spheres.shapes[i].bonds, names_of(spheres.bonds), "bond");
    if (!std::ranges::any_of(spheres.spheres, [&](const SphereGroup& group) { return group.shape == spheres.shapes[i].name; }))
      context.problems.warning(entry.header(),
                               fmt::format("no group is of the shape \"{}\", so it is never looked at", spheres.shapes[i].name),
                               "name it in a group by shape, or remove it");
    if (source != ClumpSource::tetrapod && entry.gives("file"))
      check_file(context, entry.place("file"), source == ClumpSource::file ? "file of spheres" : "surface",
                 spheres.shapes[i].file, *entry.value->find("file")->text());
  }
}

/// What a group of bodies has instead of radii.
void check_body_group(const CheckContext& context, const Entry& entry, const SpheresCase& spheres, const SphereGroup& group) {
  check_known(context, entry, "shape", entry.place("shape"), group.shape, names_of(spheres.shapes), "shape");
  if (entry.has("shape")) {
    check_keys(context, entry, "a shape", {}, {"radius", "largest_radius"});
    if (group.held)
      context.problems.error(entry.place("held"), "bodies of a shape cannot be held",
                             "use a wall of triangles for what does not move");
    return;
  }
  check_keys(context, entry, "single spheres", {}, {"rotation", "random_rotation"});
  if (group.source != SphereSource::file && group.source != SphereSource::bodies)
    check_keys(context, entry,
               group.source == SphereSource::one       ? "one sphere"
               : group.source == SphereSource::lattice ? "a lattice"
                                                       : "random places",
               {"radius"}, {});
}

/// A group of which each body in turn is lowered.
void check_lowered(const CheckContext& context, const Entry& entry, const SpheresCase& spheres, const SphereGroup& group) {
  if (!group.lowered) return;
  if (!(spheres.gravity.acceleration.norm() > 0))
    context.problems.error(entry.place("lowered"), "there is no gravity to say where down is", "give [gravity] an acceleration");
  for (const WallRules& wall : spheres.walls)
    if (wall.shape == WallShape::mesh)
      context.problems.error(entry.place("lowered"),
                             fmt::format("the wall \"{}\" is a mesh, onto which nothing can be lowered", wall.name),
                             "bodies are lowered onto planes, boxes and spheres: let the group fall with rain = true instead");
}

/// A group that falls before the run begins.
void check_rain(const CheckContext& context, const Entry& entry, const SpheresCase& spheres, const SphereGroup& group) {
  if (!group.rain) return;
  check_keys(context, entry, "rain", {}, {"velocity", "angular_velocity", "noise", "held"});
  if (!(spheres.gravity.acceleration.norm() > 0))
    context.problems.error(entry.place("rain"), "there is no gravity to fall under", "give [gravity] an acceleration");
  for (const BondRules& bond : spheres.bonds)
    if (bond.between[0] == group.name || bond.between[1] == group.name)
      context.problems.error(entry.place("rain"), fmt::format("the bonds \"{}\" join what is to fall apart", bond.name),
                             "bonds are made before it rains: remove them, or rain");
}

void check_groups(const CheckContext& context, const SpheresCase& spheres) {
  const auto materials = names_of(spheres.materials);
  const auto list = context.entries_of("spheres");
  for (std::size_t i = 0; i < list.size() && i < spheres.spheres.size(); ++i) {
    const Entry& entry = list[i];
    const SphereGroup& group = spheres.spheres[i];
    if (!entry.exists() || !entry.is_sound("source")) continue;
    check_known(context, entry, "material", entry.place("material"), group.material, materials, "material");
    check_body_group(context, entry, spheres, group);
    check_lowered(context, entry, spheres, group);
    check_rain(context, entry, spheres, group);
    switch (group.source) {
      case SphereSource::one:
        check_keys(context, entry, "one sphere", {"centre"},
                   {"file", "bodies_file", "lower", "upper", "spacing", "count", "largest_radius"});
        break;
      case SphereSource::bodies:
        check_keys(context, entry, "bodies", {"file", "bodies_file"},
                   {"shape", "centre", "radius", "lower", "upper", "spacing", "count", "largest_radius", "velocity",
                    "angular_velocity", "noise", "held", "lowered", "rain"});
        for (const auto& [key, file] : {std::pair("file", group.file), std::pair("bodies_file", group.bodies_file)})
          if (entry.gives(key)) check_file(context, entry.place(key), "file of bodies", file, *entry.value->find(key)->text());
        break;
      case SphereSource::file:
        check_keys(context, entry, "a file", {"file"},
                   {"centre", "radius", "bodies_file", "lower", "upper", "spacing", "count", "largest_radius"});
        if (entry.gives("file"))
          check_file(context, entry.place("file"), "file of spheres", group.file, *entry.value->find("file")->text());
        break;
      case SphereSource::lattice:
        check_keys(context, entry, "a lattice", {"lower", "upper"}, {"centre", "file", "bodies_file", "count", "largest_radius"});
        if (entry.gives("spacing") && entry.gives("radius") && *group.spacing < 2 * group.radius * (1 - 1e-9))
          context.problems.error(entry.place("spacing"),
                                 fmt::format("spacing {} m is below the diameter, {} m", short_number(*group.spacing),
                                             short_number(2 * group.radius)),
                                 "neighbours on the lattice would overlap");
        break;
      case SphereSource::random:
        check_keys(context, entry, "random places", {"lower", "upper", "count"}, {"centre", "file", "bodies_file", "spacing"});
        if (entry.gives("largest_radius") && entry.gives("radius") && *group.largest_radius < group.radius)
          context.problems.error(entry.place("largest_radius"), "largest_radius must be at least radius",
                                 "radius is the smallest of the two");
        break;
    }
    check_box(context, entry, group.lower, group.upper);
  }
}

/// A bond has the stiffness of a beam or of a cemented contact.
void check_bond_stiffness(const CheckContext& context, const Entry& entry) {
  const bool beam = entry.has("youngs_modulus"), cement = entry.has("bond_normal_stiffness");
  if (beam && cement)
    context.problems.error(entry.place("bond_normal_stiffness"), "youngs_modulus and bond_normal_stiffness are both given",
                           "keep one: a bond is a beam between the centres, or a cemented contact with stiffnesses per area");
  else if (beam)
    check_keys(context, entry, "youngs_modulus", {"poisson_ratio"}, {"bond_shear_stiffness"});
  else if (cement)
    check_keys(context, entry, "bond_normal_stiffness", {"bond_shear_stiffness"}, {"poisson_ratio"});
  else
    context.problems.error(entry.header(), "[[bonds]] has neither youngs_modulus nor bond_normal_stiffness",
                           how_to_add(*find_key(*entry.table, "youngs_modulus")));
}

/// What a bond joins: spheres of groups, or those of a shape that names it.
void check_bonded_groups(const CheckContext& context, const Entry& entry, const SpheresCase& spheres, const BondRules& bond) {
  const auto shape = std::ranges::find(spheres.shapes, bond.name, &ClumpShape::bonds);
  if (shape != spheres.shapes.end() && !bond.name.empty()) {
    if (entry.has("between"))
      context.problems.error(entry.place("between"),
                             fmt::format("the bonds \"{}\" join the spheres of the shape \"{}\" already", bond.name, shape->name),
                             "give bonds between groups an entry of their own");
    return;
  }
  if (!entry.has("between"))
    return context.problems.error(entry.header(), "[[bonds]] has no \"between\", and no shape names it",
                                  how_to_add(*find_key(*entry.table, "between")));
  for (std::size_t k = 0; k < 2; ++k) {
    check_known(context, entry, "between", entry.place("between", k), bond.between[k], names_of(spheres.spheres), "group");
    const auto group = std::ranges::find(spheres.spheres, bond.between[k], &SphereGroup::name);
    if (group == spheres.spheres.end() || group->shape.empty()) continue;
    const auto of = std::ranges::find(spheres.shapes, group->shape, &ClumpShape::name);
    if (of == spheres.shapes.end() || of->bonds.empty())
      context.problems.error(entry.place("between", k),
                             fmt::format("the group \"{}\" is of rigid bodies, which bonds cannot join", group->name),
                             "bond single spheres, or give the shape bonds of its own");
  }
}

void check_bonds(const CheckContext& context, const SpheresCase& spheres) {
  const auto list = context.entries_of("bonds");
  for (std::size_t i = 0; i < list.size() && i < spheres.bonds.size(); ++i) {
    const Entry& entry = list[i];
    if (!entry.exists()) continue;
    check_bonded_groups(context, entry, spheres, spheres.bonds[i]);
    check_bond_stiffness(context, entry);
    if (spheres.bonds[i].breaks() && laws::visit_law(spheres.contact.model, []<class Law>(Law) { return Law::adheres; }))
      context.problems.error(entry.header(), fmt::format("bonds that break do not go with {}", law_text(spheres.contact.model)),
                             "the contact that a broken bond leaves has an initial overlap, without adhesion: give no strength, "
                             "or another contact model");
    if (entry.has("fracture_energy") && !entry.has("tensile_strength"))
      context.problems.error(entry.place("fracture_energy"), "fracture_energy without tensile_strength",
                             how_to_add(*find_key(*entry.table, "tensile_strength")));
    if (entry.has("friction_angle") && !entry.has("cohesion"))
      context.problems.error(entry.place("friction_angle"), "friction_angle without cohesion",
                             how_to_add(*find_key(*entry.table, "cohesion")));
  }
}

/// A plane is the same in every image of a periodic domain.
void check_plane_repeats(const CheckContext& context, const Entry& entry, const Domain& domain, const Vector3& normal) {
  constexpr Real along = 1e-9;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[static_cast<std::size_t>(axis)] && std::abs(normal[axis]) > along * normal.norm())
      context.problems.error(
          entry.place("normal"),
          fmt::format("the normal has a component along {}, and the domain is periodic along {}", "xyz"[axis], "xyz"[axis]),
          "a plane in a periodic domain has to be parallel to the periodic axes");
}

void check_walls(const CheckContext& context, const SpheresCase& spheres) {
  const auto materials = names_of(spheres.materials), motions = names_of(spheres.motions);
  const auto list = context.entries_of("walls");
  for (std::size_t i = 0; i < list.size() && i < spheres.walls.size(); ++i) {
    const Entry& entry = list[i];
    const WallRules& wall = spheres.walls[i];
    if (!entry.exists() || !entry.is_sound("shape")) continue;
    check_known(context, entry, "material", entry.place("material"), wall.material, materials, "material");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string key = fmt::format("motion_{}", "xyz"[axis]);
      check_known(context, entry, key, entry.place(key), wall.motion[axis], motions, "motion");
    }
    if (wall.shape == WallShape::plane) {
      check_keys(context, entry, "a plane", {"point", "normal"}, {"lower", "upper", "file", "group", "scale"});
      if (entry.gives("normal") && !(wall.normal.norm() > 0))
        context.problems.error(entry.place("normal"), "normal has no length",
                               "write the direction across the plane, such as [0.0, 0.0, 1.0]");
      check_plane_repeats(context, entry, spheres.domain, wall.normal);
    } else if (wall.shape == WallShape::box) {
      check_keys(context, entry, "a box", {"lower", "upper"}, {"point", "normal", "file", "group", "scale"});
      check_box(context, entry, wall.lower, wall.upper);
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (spheres.domain.periodic[axis])
          context.problems.error(entry.place("shape"), fmt::format("a box has walls across the periodic axis {}", "xyz"[axis]),
                                 "use planes for the sides that are closed");
    } else {
      check_keys(context, entry, "a mesh", {"file"}, {"point", "normal", "lower", "upper"});
      if (!entry.gives("file")) continue;
      const std::string ending = wall.file.extension().string();
      if (ending != ".stl" && ending != ".STL" && ending != ".msh")
        context.problems.error(entry.place("file"), fmt::format("the surface must be an .stl or a .msh, found \"{}\"", ending),
                               "other formats can be turned into STL by most programs that draw");
      else
        check_file(context, entry.place("file"), "surface", wall.file, *entry.value->find("file")->text());
    }
  }
}

void check_gauges(const CheckContext& context, const SpheresCase& spheres) {
  const auto groups = names_of(spheres.spheres);
  const auto list = context.entries_of("gauges");
  for (std::size_t i = 0; i < list.size() && i < spheres.gauges.size(); ++i)
    check_known(context, list[i], "group", list[i].place("group"), spheres.gauges[i].group, groups, "group");
}

/// Spheres have steps of their own, or one that is given.
void check_levels(const CheckContext& context, const SpheresCase& spheres) {
  const Entry entry = context.entries_of("time").front();
  if (entry.gives("levels") && spheres.time.levels == SphereLevels::per_sphere && entry.has("step"))
    context.problems.error(entry.place("step"), "step and levels = \"per_sphere\" are both given",
                           "step is that of all spheres: keep one of them; stability_fraction sets the steps of levels");
}

void check_water_of_groups(const CheckContext& context, const SpheresCase& spheres) {
  if (spheres.water.is_there()) return;
  for (const Entry& entry : context.entries_of("spheres"))
    for (const std::string_view key : {"drag_coefficient", "inertia_coefficient"})
      if (entry.gives(key))
        context.problems.error(entry.place(key), fmt::format("{} is only for a case with [water]", key),
                               "add [water] with its level, or remove the key");
}

}  // namespace

void check_spheres(const CheckContext& context, SpheresCase& spheres) {
  check_unique_names(context, "materials", names_of(spheres.materials));
  check_unique_names(context, "shapes", names_of(spheres.shapes));
  check_unique_names(context, "spheres", names_of(spheres.spheres));
  check_unique_names(context, "bonds", names_of(spheres.bonds));
  check_unique_names(context, "walls", names_of(spheres.walls));
  check_unique_names(context, "motions", names_of(spheres.motions));
  check_unique_names(context, "gauges", names_of(spheres.gauges));
  check_domain(context, spheres.domain);
  check_materials(context, spheres);
  check_pairs(context, spheres);
  check_law_parameters(context, spheres);
  check_shapes(context, spheres);
  check_groups(context, spheres);
  check_bonds(context, spheres);
  check_walls(context, spheres);
  check_motions(context, spheres.motions, spheres.time.end);
  check_gauges(context, spheres);
  check_levels(context, spheres);
  check_water(context, spheres.water, spheres.gravity, spheres.time.end);
  std::array<Real, 3> lengths{};
  for (int axis = 0; axis < 3; ++axis)
    if (spheres.domain.periodic[static_cast<std::size_t>(axis)])
      lengths[static_cast<std::size_t>(axis)] = spheres.domain.upper[axis] - spheres.domain.lower[axis];
  check_periodic_waves(context, spheres.water, spheres.gravity, lengths);
  check_water_of_groups(context, spheres);
}

}  // namespace sazare::cases
