#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/methods/rectangles/case/fields.hpp"
#include "sazare/methods/rectangles/case/format.hpp"
#include "sazare/methods/rectangles/case/nuclei_file.hpp"
#include "sazare/methods/rectangles/packing.hpp"

namespace sazare::cases {
namespace {

constexpr Real fit_tolerance = 1e-6;       // of an element
constexpr Real most_poisson_ratio = 0.25;  // of a packing: the shear stiffness vanishes there

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

void check_in_plane(const CheckContext& context, const Entry& entry, std::string_view key, const Vector3& value) {
  if (value.z() == 0 || !entry.gives(key)) return;
  context.problems.error(entry.place(key), fmt::format("{}: z must be 0, found {}", key, short_number(value.z())),
                         "method rectangles is two-dimensional, in x and y: write 0 as the third number");
}

void check_fit(const CheckContext& context, const Entry& entry, const SquareBlock& block) {
  if (!entry.gives("lower") || !entry.gives("upper")) return;
  for (int axis = 0; axis < 2; ++axis) {
    const Real length = block.upper[axis] - block.lower[axis];
    if (!(length > 0)) {
      context.problems.error(entry.place("upper"), fmt::format("upper must be above lower on the axis {}", "xy"[axis]),
                             "lower is the corner with the smallest coordinates");
      continue;
    }
    if (block.elements == ElementShape::polygons) continue;
    const Real count = block.element_size > 0 ? length / block.element_size : 1;
    if (std::abs(count - std::round(count)) <= fit_tolerance && count > 0.5) continue;
    const Real whole = std::max(std::round(count), Real{1});
    context.problems.error(
        entry.place("element_size"),
        fmt::format("the lattice does not fit the block: {} m on the axis {} is {} times {} m", short_number(length, 12),
                    "xy"[axis], short_number(count), short_number(block.element_size, 12)),
        fmt::format("the nearest element_size that fits is {} m", short_number(length / whole, 12)));
  }
}

/// The nuclei of polygons: from a file, or by a size; around them a convex block.
void check_polygons(const CheckContext& context, const Entry& entry, SquareBlock& block) {
  const bool has_file = entry.has("nuclei"), has_size = entry.has("element_size");
  if (block.shape == BlockShape::image)
    return context.problems.error(entry.place("shape"), "polygons do not fill an image",
                                  "choose shape \"rectangle\" or \"polygon\", or elements = \"squares\"");
  if (has_file == has_size)
    return context.problems.error(has_file ? *entry.value->key_place("nuclei") : entry.header(),
                                  fmt::format("the block \"{}\" has {}", block.name,
                                              has_file ? "both element_size and nuclei" : "neither element_size nor nuclei"),
                                  "give element_size for generated nuclei, or a file of nuclei");
  if (has_file && entry.has("seed"))
    context.problems.error(*entry.value->key_place("seed"), "seed is not for nuclei from a file", "remove it");
  const bool has_outline =
      block.shape == BlockShape::polygon
          ? entry.gives("points") && block.points.front() == block.points.back()
          : entry.gives("lower") && entry.gives("upper") && (block.upper - block.lower).head<2>().minCoeff() > 0;
  if (!has_outline) return;
  if (!geometry::is_convex(outline_of(block)))
    return context.problems.error(entry.place("points"), fmt::format("the block \"{}\" of polygons is not convex", block.name),
                                  "cut it into convex blocks, or choose elements = \"squares\"");
  if (!entry.gives("nuclei")) return;
  const std::string as_written = *entry.value->find("nuclei")->text();
  if (check_file(context, entry.place("nuclei"), "file of nuclei", block.nuclei, as_written))
    read_nuclei(block, (context.shown_folder / as_written).lexically_normal().string(), entry.place("nuclei"), context.problems);
}

void check_block(const CheckContext& context, const Entry& entry, SquareBlock& block) {
  if (!entry.exists() || !entry.is_sound("shape") || !entry.is_sound("elements")) return;
  check_in_plane(context, entry, "lower", block.lower);
  check_in_plane(context, entry, "upper", block.upper);
  if (block.elements == ElementShape::circles && !entry.has("element_size"))
    context.problems.error(entry.place("elements"), "circles need an element_size", "give their diameter as element_size");
  const bool polygons = block.elements == ElementShape::polygons;
  if (polygons)
    check_polygons(context, entry, block);
  else
    check_keys(context, entry, "squares and circles", {}, {"nuclei", "seed"});
  switch (block.shape) {
    case BlockShape::rectangle:
      check_keys(context, entry, "a rectangle", {"lower", "upper"}, {"points", "file"});
      check_fit(context, entry, block);
      return;
    case BlockShape::polygon:
      check_keys(context, entry, "a polygon", {"points"}, {"lower", "upper", "file"});
      if (!polygons) check_keys(context, entry, "a polygon", {"element_size"}, {});
      if (entry.gives("points") && block.points.front() != block.points.back())
        context.problems.error(entry.place("points"), fmt::format("the block \"{}\" is not closed", block.name),
                               "write the first point again at the end");
      return;
    case BlockShape::image:
      check_keys(context, entry, "an image", {"file", "lower", "element_size"}, {"points", "upper"});
      if (entry.gives("file")) check_file(context, entry.place("file"), "image", block.file, *entry.value->find("file")->text());
      return;
  }
}

void check_blocks(const CheckContext& context, RectanglesCase& rectangles) {
  const auto list = context.entries_of("blocks");
  const std::vector<std::string> materials = names_of(rectangles.materials);
  for (std::size_t i = 0; i < list.size(); ++i) {
    SquareBlock& block = rectangles.blocks[i];
    check_block(context, list[i], block);
    if (list[i].gives("material") && std::ranges::find(materials, block.material) == materials.end())
      context.problems.error(list[i].place("material"), fmt::format("there is no material \"{}\"", block.material),
                             full_suggestion(block.material, materials, "materials"));
  }
}

void check_material(const CheckContext& context, const Entry& entry, const SquareMaterial& material) {
  if (!entry.exists()) return;
  const bool springs = entry.has("face_normal_stiffness") && entry.has("face_shear_stiffness");
  const bool moduli = entry.has("youngs_modulus") && entry.has("poisson_ratio");
  const int given = static_cast<int>(
      std::ranges::count_if(std::array{"face_normal_stiffness", "face_shear_stiffness", "youngs_modulus", "poisson_ratio"},
                            [&](const char* key) { return entry.has(key); }));
  if (given != 2 || !(springs || moduli))
    context.problems.error(
        entry.header(), fmt::format("the stiffness of the material \"{}\" is not given by two keys", material.name),
        "give face_normal_stiffness and face_shear_stiffness, or youngs_modulus and poisson_ratio, and no others");
  if (material.layout == SpringLayout::ends && entry.has("springs") && material.springs != 2)
    context.problems.error(entry.place("springs"), fmt::format("layout \"ends\" has 2 springs, found {}", material.springs),
                           "remove springs, or choose layout \"centres\"");
}

/// The stiffnesses of a packing, for a material that gives moduli and that blocks of polygons take.
void check_material_of_polygons(const CheckContext& context, const Entry& entry, const RectanglesCase& rectangles,
                                SquareMaterial& material) {
  if (!entry.exists() || !(material.youngs_modulus > 0)) return;
  const auto takes = [&](bool polygons) {
    return std::ranges::any_of(rectangles.blocks, [&](const SquareBlock& block) {
      return block.material == material.name && (block.elements == ElementShape::polygons) == polygons;
    });
  };
  if (!takes(true)) return;
  if (takes(false))
    return context.problems.error(
        entry.place("youngs_modulus"),
        fmt::format(
            "blocks of polygons and others have the material \"{}\", but youngs_modulus gives different stiffnesses in each",
            material.name),
        "give two materials, or face_normal_stiffness and face_shear_stiffness");
  if (!(material.poisson_ratio < most_poisson_ratio))
    return context.problems.error(
        entry.place("poisson_ratio"),
        fmt::format("poisson_ratio must be below {} for polygons, found {}", most_poisson_ratio,
                    short_number(material.poisson_ratio)),
        "springs between centres cannot represent more; with 0 a packing reproduces a uniform strain exactly");
  const auto stiffness = methods::rectangles::facet_stiffness(material.youngs_modulus, material.poisson_ratio);
  material.normal_stiffness = stiffness.normal;
  material.shear_stiffness = stiffness.shear;
}

void check_support(const CheckContext& context, const Entry& entry, const SupportMotion& moves,
                   const std::vector<std::string>& motions) {
  if (!entry.exists()) return;
  check_in_plane(context, entry, "velocity", moves.velocity);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string key = std::string("motion_") + "xy"[axis];
    if (!entry.gives(key)) continue;
    if (std::ranges::find(motions, moves.motion[axis]) == motions.end())
      context.problems.error(entry.place(key), fmt::format("there is no motion \"{}\"", moves.motion[axis]),
                             full_suggestion(moves.motion[axis], motions, "motions"));
    if (!moves.velocity.isZero())
      context.problems.error(entry.place(key), "a support has either a velocity or a motion, not both", "remove one of them");
  }
}

void check_supports(const CheckContext& context, const RectanglesCase& rectangles) {
  const std::vector<std::string> motions = names_of(rectangles.motions);
  const auto walls = context.entries_of("walls"), rollers = context.entries_of("rollers");
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = rectangles.walls[i];
    check_support(context, walls[i], wall.moves, motions);
    check_in_plane(context, walls[i], "from", wall.from);
    check_in_plane(context, walls[i], "to", wall.to);
    if (walls[i].gives("from") && walls[i].gives("to") && wall.from == wall.to)
      context.problems.error(walls[i].place("to"), fmt::format("the wall \"{}\" has no length", wall.name),
                             "its start and end points coincide: give two different points");
  }
  for (std::size_t i = 0; i < rollers.size(); ++i) {
    check_support(context, rollers[i], rectangles.rollers[i].moves, motions);
    check_in_plane(context, rollers[i], "center", rectangles.rollers[i].center);
  }
}

}  // namespace

void check_rectangles(const CheckContext& context, RectanglesCase& rectangles) {
  check_unique(context, "blocks", rectangles.blocks);
  check_unique(context, "materials", rectangles.materials);
  check_unique(context, "walls", rectangles.walls);
  check_unique(context, "rollers", rectangles.rollers);
  check_names_apart(context, "walls", names_of(rectangles.walls), "rollers", names_of(rectangles.rollers));
  check_unique(context, "motions", rectangles.motions);
  check_unique(context, "gauges", rectangles.gauges);
  check_blocks(context, rectangles);
  const auto materials = context.entries_of("materials");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    check_material(context, materials[i], rectangles.materials[i]);
    check_material_of_polygons(context, materials[i], rectangles, rectangles.materials[i]);
  }
  check_motions(context, rectangles.motions, rectangles.time.end);
  check_supports(context, rectangles);
  check_in_plane(context, context.entries_of("gravity").front(), "acceleration", rectangles.gravity.acceleration);
  check_in_plane(context, context.entries_of("base_friction").front(), "velocity", rectangles.plate.velocity);
}

}  // namespace sazare::cases
