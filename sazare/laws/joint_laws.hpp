#pragma once

/// The laws that bonded faces of blocks may have: a list of types.
///
/// A law is a type that names what a joint bears across its face, `Tension`, and along it, `Shear`, each a struct of numbers for
/// `P` = Real, and for `P` = Lanes where every lane has numbers of its own. The concept below says which functions belong to
/// them. They are templates, so one number and lanes take the same steps, and the kernel is made for each law of the list. A law
/// takes its parameters from any struct that has them as members, named as the keys of a case are.
///
/// Every vertex of a joint has two memories: the largest opening so far, `peak`, and the slip so far. A joint of any law breaks
/// when one of its vertices has failed.

#include <concepts>
#include <tuple>

#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"

namespace sazare::laws {

/// What the kernel asks of a law, per unit of area; tension is positive.
template <class Law>
concept JointLaw = requires(typename Law::template Tension<Lanes> tension, typename Law::template Shear<Lanes> shear,
                            Lanes number, Slip<Lanes> slip) {
  { tension.stiffness } -> std::convertible_to<Lanes>;                  // below and up to `elastic_peak` [Pa/m]
  { elastic_peak(tension) } -> std::same_as<Lanes>;                     // the largest opening that leaves a joint intact [m]
  { is_softened(tension, number) } -> std::same_as<LaneMask>;           // by the peak: it is above that
  { has_failed(tension, number) } -> std::same_as<LaneMask>;            // by the peak
  { softened_stress(tension, number, number) } -> std::same_as<Lanes>;  // by opening and peak, intact or not [Pa]
  { stored_energy(tension, number, number) } -> std::same_as<Lanes>;    // by opening and stress [J/m2]
  { fracture_dissipation(tension, number) } -> std::same_as<Lanes>;     // by the peak [J/m2]
  { shear.stiffness } -> std::convertible_to<Lanes>;                    // [Pa/m]
  { shear_strength(shear, number) } -> std::same_as<Lanes>;             // by the normal stress [Pa]
  { slips(shear, slip, number) } -> std::same_as<LaneMask>;             // by that strength
  slip_back(shear, slip, number);                                       // until it bears no more than that strength
  tension.numbers();                                                    // all it has, as references
  shear.numbers();                                                      // and likewise
};

/// Linear softening in tension, Coulomb's slip along the face. [Konno2018], 2.1.
struct LinearSoftening {
  template <class P>
  using Tension = TensionParameters<P>;
  template <class P>
  using Shear = ShearParameters<P>;

  template <class Joint>
  static JointTension tension(const Joint& joint) {
    return JointTension::make(joint.normal_stiffness, joint.tensile_strength, joint.fracture_energy);
  }
  template <class Joint>
  static JointShear shear(const Joint& joint) {
    return {joint.shear_stiffness, joint.cohesion, joint.friction_coefficient};
  }
};

/// A law that stands here can be had by every joint.
using JointLaws = std::tuple<LinearSoftening>;

}  // namespace sazare::laws
