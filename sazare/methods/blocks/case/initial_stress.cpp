#include <fmt/format.h>

#include <algorithm>

#include "sazare/methods/blocks/case/checks.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 4> stress_keys{"normal_stress", "shear_stress", "normal_stress_per_depth",
                                                      "shear_stress_per_depth"};

Matrix3 tensor(const Vector3& normal, const Vector3& shear) {
  Matrix3 stress;
  stress << normal.x(), shear.x(), shear.z(),  //
      shear.x(), normal.y(), shear.y(),        //
      shear.z(), shear.y(), normal.z();
  return stress;
}

/// Number of the axis along which gravity acts, or -1.
int axis_of_gravity(const Vector3& acceleration) {
  const auto along = (acceleration.array() != 0).count();
  Eigen::Index axis = 0;
  acceleration.cwiseAbs().maxCoeff(&axis);
  return along == 1 ? static_cast<int>(axis) : -1;
}

}  // namespace

bool InitialStress::is_zero() const {
  return !k0 && normal.isZero(0) && shear.isZero(0) && normal_per_depth.isZero(0) && shear_per_depth.isZero(0);
}

laws::LinearStress BlocksCase::stress_at_start() const {
  laws::LinearStress stress;
  const Vector3& pull = gravity.acceleration;
  if (!pull.isZero(0)) stress.down = pull.normalized();
  stress.datum = initial_stress.datum;
  if (initial_stress.k0) {
    const Real weight = materials.front().density * pull.norm();  // per volume
    Vector3 ratio = Vector3::Constant(*initial_stress.k0);
    ratio[axis_of_gravity(pull)] = 1;
    stress.per_depth = tensor(-weight * ratio, Vector3::Zero());
  } else {
    stress.at_datum = tensor(initial_stress.normal, initial_stress.shear);
    stress.per_depth = tensor(initial_stress.normal_per_depth, initial_stress.shear_per_depth);
  }
  return stress;
}

void check_settling(const CheckContext& context, const BlocksCase& blocks) {
  const bool has_weight = !blocks.gravity.acceleration.isZero(0);
  for (const auto& [table, settles] :
       {std::pair{"gravity", blocks.gravity.settle}, {"initial_stress", blocks.initial_stress.settle}}) {
    if (!settles) continue;
    const auto place = context.entries_of(table).front().place("settle");
    if (!has_weight && blocks.initial_stress.is_zero())
      context.problems.error(place, "settle requires gravity or an initial stress", "give one of them, or remove settle");
    else if (has_weight && blocks.boundaries.empty() && blocks.constraints.empty())
      context.problems.error(place, "under gravity nothing holds the body, and it would fall while it settles",
                             "give it [[boundaries]] to stand on or hold a region with [[constraints]], or remove settle");
  }
}

void check_initial_stress(const CheckContext& context, const BlocksCase& blocks) {
  const Entry entry = context.entries_of("initial_stress").front();
  if (!entry.exists()) return;
  if (blocks.water.is_there() && !blocks.initial_stress.is_zero())
    context.problems.error(context.entries_of("water").front().place("level"),
                           "water and an initial stress cannot be combined in method blocks",
                           "the initial stress is in equilibrium with the dry weight: remove one of the two");
  for (std::size_t joint = 0; joint < blocks.joints.size(); ++joint)
    if (blocks.joints[joint].shear_stiffness == Real{0} && !blocks.initial_stress.is_zero())
      context.problems.error(context.entries_of("joints")[joint].place("joint_shear_stiffness"),
                             "a joint without shear stiffness cannot carry the initial stress",
                             "give it a joint_shear_stiffness greater than 0");
  if (!entry.has("k0")) return;
  for (const std::string_view key : stress_keys)
    if (entry.has(key))
      context.problems.error(entry.place(key), fmt::format("the initial stress is given twice, by k0 and by {}", key),
                             "keep one");
  if (axis_of_gravity(blocks.gravity.acceleration) < 0)
    context.problems.error(entry.place("k0"), "k0 needs gravity along one axis, from which the weight of the ground follows",
                           "give [gravity] an acceleration along x, y or z, or give the stresses themselves");
  const auto differs = [&](const Material& material) { return material.density != blocks.materials.front().density; };
  if (std::ranges::any_of(blocks.materials, differs))
    context.problems.error(entry.place("k0"), "k0 is for ground of one density, and the materials have several",
                           "give normal_stress and normal_stress_per_depth instead");
}

}  // namespace sazare::cases
