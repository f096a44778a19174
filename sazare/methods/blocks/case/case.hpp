#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sazare/cases/tables.hpp"
#include "sazare/cases/water/table.hpp"
#include "sazare/laws/block_elasticity.hpp"
#include "sazare/laws/deformable_block.hpp"
#include "sazare/laws/dynamic_increase.hpp"
#include "sazare/laws/explosives.hpp"
#include "sazare/laws/joint_laws.hpp"
#include "sazare/laws/linear_stress.hpp"
#include "sazare/laws/pressure_table.hpp"

/// A checked case of method blocks, as plain data. All values in SI units; friction always as a coefficient;
/// files as paths that can be opened from anywhere. Every member is one key of the case file (`schema.cpp`
/// lists them with unit, range and default).
namespace sazare::cases {

using laws::JointLawName;

/// How a contact dashpot that is stiffer than the step allows is limited.
enum class DampingCap { literal, critical, step };

/// What touches of blocks that are not joined.
enum class ContactShape { spheres, faces };

/// Who takes its own time level: every element, or all together the finest that any asks for.
enum class Levels { per_element, uniform };

/// What sets the step of an element.
enum class Limiter { stability, travel, none };

enum class BoundaryKind { fixed, frictionless, absorbing, prescribed };

struct Material {
  std::string name;
  std::vector<std::string> regions;
  Real density = 0;  // kg/m3
  std::optional<Real> youngs_modulus = std::nullopt;  // Pa; with poisson_ratio: joints take their springs from it
  std::optional<Real> poisson_ratio = std::nullopt;
  bool deformable = false;      // its elements strain; else they are rigid, and as elastic as their joints
  Real bulk_damping_ratio = 0;  // of deformable elements

  bool has_moduli() const { return youngs_modulus && poisson_ratio; }
  laws::ElasticModuli moduli() const { return {youngs_modulus.value(), poisson_ratio.value()}; }
  /// From the centre of an element to its faces.
  laws::SpringModuli springs() const { return deformable ? laws::joint_moduli(moduli()) : laws::spring_moduli(moduli()); }
};

/// Applies between two materials (`between`) or on a surface group inside the body (`surface`); the other one
/// is empty. The last entry of the case that matches a face wins.
struct Joint {
  std::string name;
  std::array<std::string, 2> between;
  std::string surface;
  bool bonded = true;         // false: what stands below means nothing and is 0
  JointLawName law = JointLawName::linear_softening;
  std::optional<Real> normal_stiffness = std::nullopt;  // Pa/m; both or none: then the elements beside a face give it
  std::optional<Real> shear_stiffness = std::nullopt;   // Pa/m
  Real normal_damping = 0;                              // Pa s/m
  Real shear_damping = 0;                               // Pa s/m
  std::optional<Real> damping_ratio = std::nullopt;     // instead of the two dashpots
  Real cohesion = 0;          // Pa
  Real friction_coefficient = 0;
  Real tensile_strength = 0;  // Pa
  Real fracture_energy = 0;   // N/m
  laws::JointLawParameters law_parameters;
  std::optional<Real> weibull_modulus = std::nullopt;  // without it all faces have the same strength
  int scatter_seed = 1;
  laws::DynamicIncrease by_rate;  // of tensile strength, cohesion and both fracture energies

  /// The value of a parameter of its law, by name.
  const std::optional<Real>& law_parameter(std::string_view parameter) const {
    return laws::parameter_of<laws::JointLaws>(law_parameters, parameter);
  }

  /// Factors on the strength that its faces have, equally many of each.
  std::vector<Real> strength_factors() const;
  /// The largest of them.
  Real largest_factor() const { return strength_factors().back(); }
  /// Itself, with strengths and fracture energies times a factor.
  Joint scaled(Real factor) const;

  bool on_surface() const { return !surface.empty(); }
  /// Whether its law is one of natural joints, which have no strength without pressure and take no number for it.
  bool is_natural() const { return bonded && laws::is_natural(law); }
  bool has_stiffness() const { return normal_stiffness && shear_stiffness; }
  bool follows_rate() const { return bonded && by_rate.law != laws::RateLawName::none; }
  /// Whether each of its faces has springs or dashpots that depend on the elements beside it.
  bool depends_on_elements() const { return bonded && (!has_stiffness() || damping_ratio); }
};

struct Contact {
  ContactShape shape = ContactShape::spheres;
  Real normal_stiffness = 0;  // N/m, per pair of contact spheres; 0: not given
  Real normal_damping = 0;    // N s/m
  Real face_stiffness = 0;    // Pa/m, of true faces
  Real face_damping = 0;      // Pa s/m
  Real friction_coefficient = 0;
  DampingCap damping_cap = DampingCap::step;
  int edge_division = 5;
};

/// Equation (4) of the blasting paper: P0 cos2 over the rise, then a quarter of a cosine down to zero.
struct PressurePulse {
  Real peak_pressure = 0;  // Pa
  Real rise_time = 0;      // s
  Real decay_ratio = 0;    // decay time over rise time
};

/// Straight lines between the rows; before the first and after the last row the pressure is zero.
struct PressureTable {
  std::filesystem::path file;
  std::vector<Real> time;      // s, strictly increasing
  std::vector<Real> pressure;  // Pa
};

/// A function of time that only the caller of the engine knows: it hands over samples while the run goes on.
struct PressureFunction {
  std::shared_ptr<laws::PressureTable> samples = std::make_shared<laws::PressureTable>();
};

struct Blast {
  std::string name;
  std::string surface;
  Real delay = 0;  // s
  std::variant<PressurePulse, PressureTable, PressureFunction> pressure;
  Real cut_distance = std::numeric_limits<Real>::infinity();  // m
};

/// Which explosive a charge has: a row of laws::explosives, or the one after the last, whose constants the case gives itself.
enum class ExplosiveName {};
inline constexpr ExplosiveName custom_explosive{static_cast<int>(laws::explosives.size())};

/// A charge in a hole; depths are distances from the collar along the hole.
/// What the gas of a charge does where rock has cracked.
enum class GasInCracks { none, share, flow };

struct Charge {
  std::string name;
  std::string surface;
  Vector3 collar = Vector3::Zero();                    // m
  Vector3 toe = Vector3::Zero();                       // m
  Real diameter = 0;                                   // m, of the hole
  std::optional<Real> charge_diameter = std::nullopt;  // m; none: it fills the hole
  Real share = 1;                                      // of the hole that the mesh has
  Real top = 0;                                        // m
  std::optional<Real> bottom = std::nullopt;           // m; none: at the toe
  std::optional<Real> primer = std::nullopt;           // m; none: at the bottom
  bool vents = false;
  Real stemming_density = 0;     // kg/m3
  Real stemming_resistance = 0;  // Pa
  GasInCracks gas_in_cracks = GasInCracks::none;
  Real crack_pressure_share = 1;  // of the pressure in the hole
  Real crack_aperture = 0;        // m
  Real discharge_coefficient = 1;
  ExplosiveName explosive = custom_explosive;
  std::optional<Real> density = std::nullopt;              // kg/m3
  std::optional<Real> detonation_velocity = std::nullopt;  // m/s; may replace that of the table
  std::optional<Real> energy = std::nullopt;               // J/kg
  std::optional<Real> gas_exponent = std::nullopt;
  std::array<std::optional<Real>, 5> jwl = {};  // A, B [Pa], R1, R2, omega
  Real delay = 0;                               // s
  Real delay_scatter = 0;                       // s
  int scatter_seed = 1;
  Real cut_distance = std::numeric_limits<Real>::infinity();  // m

  bool is_custom() const { return explosive == custom_explosive; }
  Real hole_length() const { return (toe - collar).norm(); }
  Real bottom_depth() const { return bottom.value_or(hole_length()); }
  Real primer_depth() const { return primer.value_or(bottom_depth()); }
  Real explosive_diameter() const { return charge_diameter.value_or(diameter); }
  /// The explosive with its constants, from the table or the case.
  laws::Explosive filling() const;
  Real volume() const;  // of the explosive in the mesh, m3
  /// When the primer fires, with its scatter [s]. Charges of one case differ by their place in it.
  Real firing_time(std::size_t place) const;
};

struct Boundary {
  std::string surface;
  BoundaryKind kind = BoundaryKind::fixed;
  std::array<std::string, 3> motion = {};  // names of motions of the ground by axis, or empty

  /// Whether it carries loads along every axis.
  bool holds_all_axes() const { return kind == BoundaryKind::fixed || kind == BoundaryKind::prescribed; }
  /// Whether its ground may be given a motion; the one behind an absorbing boundary is that of the incident wave.
  bool can_move() const { return kind != BoundaryKind::fixed; }
};

/// Axes x, y, z that are locked.
struct Constraint {
  std::vector<std::string> regions;
  std::array<bool, 3> translation{false, false, false};
  std::array<bool, 3> rotation{false, false, false};
};

struct BlockGravity : Gravity {
  bool settle = false;
};

/// Stress in the ground before anything is done to it, tension positive.
struct InitialStress {
  Vector3 normal = Vector3::Zero();            // Pa: xx, yy, zz at the datum
  Vector3 shear = Vector3::Zero();             // Pa: xy, yz, zx at the datum
  Vector3 normal_per_depth = Vector3::Zero();  // Pa/m
  Vector3 shear_per_depth = Vector3::Zero();   // Pa/m
  std::optional<Real> k0;                      // instead of these: from the weight of the ground above
  Real datum = 0;                              // m
  bool settle = false;

  bool is_zero() const;
};

struct InitialVelocity {
  std::vector<std::string> regions;
  Vector3 velocity = Vector3::Zero();  // m/s
};

struct Time {
  Real end = 0;  // s
  Levels levels = Levels::per_element;
  Limiter limiter = Limiter::stability;
  std::optional<Real> base_step;  // s; absent: the engine chooses it so that it divides history_interval
  Real stability_fraction = 0.5;
  Real travel_length = 1e-8;  // m
  int neighbor_levels = 2;
  Real history_interval = 0;   // s; a whole number of base steps where base_step is given
  Real snapshot_interval = 0;  // s; a whole number of history intervals, and the end a whole number of these
  bool strict = false;
};

struct BlocksCase {
  std::string title;
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<Joint> joints;
  Contact contact;
  std::vector<Blast> blasts;
  std::vector<Charge> charges;
  BlockGravity gravity;
  WaterOnFaces water;
  InitialStress initial_stress;
  std::vector<Motion> motions;
  std::vector<Boundary> boundaries;
  std::vector<Constraint> constraints;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<Gauge> gauges;
  Time time;
  Output output;

  /// The initial stress with the weight of the ground where it is given by k0.
  laws::LinearStress stress_at_start() const;
  /// Whether it begins in equilibrium: either of the tables says so.
  bool settles() const { return gravity.settle || initial_stress.settle; }
};

}  // namespace sazare::cases
