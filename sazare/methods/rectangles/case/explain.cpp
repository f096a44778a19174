#include <fmt/format.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/explanation.hpp"
#include "sazare/methods/rectangles/case/fields.hpp"
#include "sazare/methods/rectangles/case/format.hpp"

namespace sazare::cases {
namespace {

std::string moves_text(const SupportMotion& moves) {
  if (!moves.velocity.isZero())
    return fmt::format(", moves with ({}, {}) m/s", number(moves.velocity.x()), number(moves.velocity.y()));
  return motion_names_text(moves.motion);
}

std::string block_text(const SquareBlock& block) {
  const std::string_view shape = EnumWords<BlockShape>::words.at(static_cast<std::size_t>(block.shape));
  const std::string_view elements = EnumWords<ElementShape>::words.at(static_cast<std::size_t>(block.elements));
  const std::string how = !block.nuclei.empty()    ? fmt::format("{} around {} nuclei", elements, block.places.size())
                          : block.element_size > 0 ? fmt::format("{} of {} m", elements, number(block.element_size))
                                                   : std::string("one element");
  return fmt::format("{}: {} of {}, {}", block.name, shape, block.material, how) +
         (block.angle != 0 ? fmt::format(", turned by {} deg", number(block.angle)) : "");
}

std::string material_text(const SquareMaterial& material) {
  return fmt::format("{}: {} kg/m3, k_n {} Pa, k_s {} Pa, {} {}, tensile strength {} Pa, cohesion {} Pa, friction angle {} deg",
                     material.name, number(material.density), number(material.normal_stiffness), number(material.shear_stiffness),
                     material.layout == SpringLayout::ends ? 2 : material.springs,
                     material.layout == SpringLayout::ends ? "springs at the ends of a face" : "springs on a face",
                     number(material.tensile_strength), number(material.cohesion), number(material.friction_angle));
}

}  // namespace

std::string explain(const RectanglesCase& rectangles) {
  std::string text = rectangles.title + "\n";
  for (const SquareBlock& block : rectangles.blocks) text += line("blocks", block_text(block));
  for (const SquareMaterial& material : rectangles.materials) text += line("materials", material_text(material));
  text += line("contact", fmt::format("k_n {} Pa, k_s {} Pa, damping {}, friction {} deg",
                                      number(rectangles.contact.normal_stiffness), number(rectangles.contact.shear_stiffness),
                                      number(rectangles.contact.damping_ratio), number(rectangles.contact.friction_angle)));
  text += explain_gravity(rectangles.gravity.acceleration);
  text += explain_motions(rectangles.motions, rectangles.time.end);
  for (const Wall& wall : rectangles.walls) text += line("walls", wall.name + moves_text(wall.moves));
  for (const Roller& roller : rectangles.rollers)
    text += line("rollers", fmt::format("{}: radius {} m", roller.name, number(roller.radius)) + moves_text(roller.moves));
  if (rectangles.plate.friction_coefficient > 0)
    text += line("plate", fmt::format("friction {}, moves with ({}, {}) m/s", number(rectangles.plate.friction_coefficient),
                                      number(rectangles.plate.velocity.x()), number(rectangles.plate.velocity.y())));
  const auto count = [&](Real interval) { return whole_multiple(rectangles.time.end, interval).value_or(0); };
  const UniformTime& time = rectangles.time;
  text += line("time", fmt::format("to {} s, {} history rows, {} snapshots", number(time.end), count(time.history_interval),
                                   count(time.snapshot_interval)));
  return text;
}

}  // namespace sazare::cases
