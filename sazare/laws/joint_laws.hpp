#pragma once

/// The laws that bonded faces of blocks may have: a list of types.
///
/// A law is a type that names what a joint bears across its face, `Tension`, and along it, `Shear`, each a struct of numbers for
/// `P` = Real, and for `P` = Lanes where every lane has numbers of its own. The concept below says which functions belong to
/// them. They are templates, so one number and lanes take the same steps, and the kernel is made for each law of the list. A law
/// takes its numbers from any struct that has them as members, named as the keys of a case are, and those that it alone takes,
/// `parameters`, from an array in their order.
///
/// Every vertex of a joint has two memories: the largest opening so far, `peak`, and the slip so far. A joint of any law breaks
/// when one of its vertices has failed. A law that softens by slip, SoftensBySlip, has a third, the path of slip, by which and by
/// the largest opening it has a damage between 0 and 1. A law of natural joints, DilatesBySlip, has the path too, and the
/// dilation so far in the place of the largest opening; it bears pressure and friction alone, and closes and opens as often as
/// its sides do.

#include <concepts>
#include <optional>
#include <tuple>

#include "sazare/laws/joint_barton_bandis.hpp"
#include "sazare/laws/joint_mixed_mode.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::laws {

/// What the kernel asks of every law, per unit of area; tension is positive.
template <class Law>
concept ElasticJointLaw = requires(typename Law::template Tension<Lanes> tension, typename Law::template Shear<Lanes> shear,
                                   Lanes number, Slip<Lanes> slip) {
  { tension.stiffness } -> std::convertible_to<Lanes>;                // below and up to `elastic_peak` [Pa/m]
  { elastic_peak(tension) } -> std::same_as<Lanes>;                   // the largest opening that leaves a joint intact [m]
  { failure_peak(tension) } -> std::same_as<Lanes>;                   // the opening at which it bears nothing any more [m]
  { elastic_limit(tension) } -> std::same_as<Lanes>;                  // and the stress there [Pa]
  { stored_energy(tension, number, number) } -> std::same_as<Lanes>;  // by opening and stress [J/m2]
  { shear.stiffness } -> std::convertible_to<Lanes>;                  // [Pa/m]
  { slips(shear, slip, number) } -> std::same_as<LaneMask>;           // by the shear strength
  set_stiffness(tension, number);                                     // of a face that has its own; strength stays
  set_stiffness(shear, number);                                       // and likewise
  scale_strength(tension, number, number);                            // strength, and the opening at which it is used up
  scale_strength(shear, number, number);                              // and likewise, by slip
  tension.numbers();                                                  // all it has, as references
  shear.numbers();                                                    // and likewise
};

/// A law that softens by opening alone.
template <class Law>
concept SoftensByOpening = ElasticJointLaw<Law> && requires(typename Law::template Tension<Lanes> tension,
                                                            typename Law::template Shear<Lanes> shear, Lanes number, Slip<Lanes> slip) {
  { is_softened(tension, number) } -> std::same_as<LaneMask>;           // by the peak: it is above that
  { has_failed(tension, number) } -> std::same_as<LaneMask>;            // by the peak
  { softened_stress(tension, number, number) } -> std::same_as<Lanes>;  // by opening and peak, intact or not [Pa]
  { fracture_dissipation(tension, number) } -> std::same_as<Lanes>;     // by the peak [J/m2]
  { shear_strength(shear, number) } -> std::same_as<Lanes>;             // by the normal stress [Pa]
  slip_back(shear, slip, number);                                       // until it bears no more than that strength
};

/// A law that softens by opening and by slip.
template <class Law>
concept SoftensBySlip = ElasticJointLaw<Law> && requires(typename Law::template Tension<Lanes> tension,
                                                         typename Law::template Shear<Lanes> shear, Lanes number,
                                                         SofteningSlip<Lanes> slip) {
  { damage(tension, shear, number, number) } -> std::same_as<Lanes>;                // by peak and path of slip
  { damaged_stress(tension, number, number, number) } -> std::same_as<Lanes>;       // by opening, peak and damage [Pa]
  { opening_dissipation(tension, number, number, number) } -> std::same_as<Lanes>;  // by both peaks, and damage before [J/m2]
  { shear_strength(shear, number, number) } -> std::same_as<Lanes>;                 // by normal stress and damage [Pa]
  slip_and_soften(shear, slip, number, number, number);                             // by normal stress, damage and path
  { Law::shear_energy } -> std::convertible_to<std::string_view>;                   // the parameter that slip dissipates [J/m2]
};

/// A law of natural joints, which bear pressure and friction alone.
template <class Law>
concept DilatesBySlip = ElasticJointLaw<Law> &&
    requires(typename Law::template Tension<Lanes> tension, typename Law::template Shear<Lanes> shear, Lanes number,
             typename Law::template Tension<Real> closure, typename Law::template Shear<Real> rough, RoughVertex vertex) {
  { closing_pressure(tension, number) } -> std::same_as<Lanes>;     // by the compression [Pa]
  { least_strength(shear, number) } -> std::same_as<Lanes>;         // in shear, by the pressure [Pa]
  { slide(closure, rough, vertex) } -> std::same_as<bool>;          // until it bears no more than its strength
  { compression_under(closure, Real{}) } -> std::same_as<Real>;     // by the pressure [m]
  { rough_strength(rough, Real{}, Real{}) } -> std::same_as<Real>;  // by the pressure and the share of roughness [Pa]
};

/// A law that remembers the path of slip.
template <class Law>
concept RemembersPath = SoftensBySlip<Law> || DilatesBySlip<Law>;

template <class Law>
concept JointLaw = SoftensByOpening<Law> || SoftensBySlip<Law> || DilatesBySlip<Law>;

/// Linear softening in tension, Coulomb's slip along the face. [Konno2018], 2.1.
struct LinearSoftening {
  static constexpr std::string_view word = "linear_softening";
  static constexpr std::array<LawParameter, 0> parameters{};

  template <class P>
  using Tension = TensionParameters<P>;
  template <class P>
  using Shear = ShearParameters<P>;

  template <class Joint>
  static JointTension tension(const Joint& joint, const std::array<std::optional<Real>, 0>&) {
    return joint_tension(joint);
  }
  template <class Joint>
  static JointShear shear(const Joint& joint, const std::array<std::optional<Real>, 0>&) {
    return {joint.shear_stiffness, joint.cohesion, joint.friction_coefficient};
  }
};

/// A law that stands here can be had by every joint.
using JointLaws = std::tuple<LinearSoftening, MixedMode, BartonBandis>;

/// Names for the laws where none is known at compile time.
enum class JointLawName {
  linear_softening = place_of_law<JointLaws, LinearSoftening>(),
  mixed_mode = place_of_law<JointLaws, MixedMode>(),
  barton_bandis = place_of_law<JointLaws, BartonBandis>()
};

/// What `visit(Law{})` returns for the law of a name.
template <class Visitor>
auto visit_joint_law(JointLawName name, Visitor&& visit) {
  return visit_law_at<JointLaws>(static_cast<std::size_t>(name), std::forward<Visitor>(visit));
}

/// Whether a law is one of natural joints.
inline bool is_natural(JointLawName name) {
  return visit_joint_law(name, []<class Law>(Law) { return DilatesBySlip<Law>; });
}

/// What the laws take beside stiffness, damping, friction and strength; those of other laws than the chosen one are not given.
using JointLawParameters = std::array<std::optional<Real>, parameters_of_laws<JointLaws>.size()>;

}  // namespace sazare::laws
