#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sazare/cases/blocks_case.hpp"
#include "sazare/laws/ground_motion.hpp"

/// A checked case of method mps, as plain data. All values in SI units; every member is one key of the case file.
namespace sazare::cases {

enum class ParticleFit { exact, inside };
enum class RotationRemoval { mean_rotation, mean_angle };
enum class RegionShape { rectangle, polygon, mesh };
enum class MotionShape { ricker, sine, record, function };
enum class Baseline { none, constant, linear };
enum class Side { left, right, bottom, top, front, back, all };
enum class SideKind { fixed, roller, prescribed, viscous };
enum class Integrator { verlet, leapfrog, euler };

struct ParticleRules {
  Real spacing = 0;  // m
  int dimension = 2;
  Real influence = 1.5;  // over the spacing
  ParticleFit fit = ParticleFit::exact;
  std::array<bool, 3> periodic{false, false, false};
  RotationRemoval rotation = RotationRemoval::mean_rotation;
};

struct ParticleRegion {
  std::string name;
  RegionShape shape = RegionShape::rectangle;
  Vector3 lower = Vector3::Zero();          // m, rectangle
  Vector3 upper = Vector3::Zero();          // m, rectangle
  std::vector<std::array<Real, 2>> points;  // m, polygon
  std::filesystem::path file;               // mesh: .msh or .geo
  std::string group;                        // mesh: its volume
};

struct Ground {
  std::string name;
  std::vector<std::string> regions;
  Real density = 0;            // kg/m3
  Real shear_velocity = 0;     // m/s; of the three, two are given and the third follows
  Real pressure_velocity = 0;  // m/s
  Real damping_ratio = 0;
  bool yields = false;        // whether it has a strength
  Real cohesion = 0;          // Pa
  Real friction_angle = 0;    // degrees
  Real dilation_angle = 0;    // degrees
  Real tensile_strength = 0;  // Pa
  Real rupture_strain = 0;
};

struct Damping {
  Real f1 = 0;  // Hz
  Real f2 = 0;  // Hz
};

/// `motion` holds what a run needs of it: the samples of a record, in SI units, without the baseline.
struct Motion {
  std::string name;
  MotionShape type = MotionShape::ricker;
  laws::MotionQuantity quantity = laws::MotionQuantity::acceleration;
  Real amplitude = 1;  // in the unit of the quantity; a factor for a record
  Real frequency = 0;  // Hz
  Real peak_time = 0;  // s
  Real cycles = 0;
  std::filesystem::path file;
  Baseline baseline = Baseline::none;
  laws::Record record;
  std::shared_ptr<laws::Record> samples;  // of a function: its caller adds them while the run goes on
};

struct SideBoundary {
  Side side = Side::bottom;
  SideKind kind = SideKind::fixed;
  std::array<bool, 3> axes{false, false, false};  // of a roller; none: across the side
  std::array<std::string, 3> motion;              // names of motions by axis, or empty
};

struct GroundGravity : Gravity {
  bool settle = false;
  int settling_steps = 0;  // at most
};

/// Contacts of particles whose links broke.
struct LooseContact {
  Real damping_ratio = 0;
};

/// Random velocities at the start, so that every motion that can grow is there.
struct Noise {
  Real velocity = 0;  // m/s
  int seed = 1;
};

struct UniformTime {
  Real end = 0;              // s
  std::optional<Real> step;  // s
  Real stability_fraction = 0.9;
  Integrator integrator = Integrator::verlet;
  Real history_interval = 0;   // s
  Real snapshot_interval = 0;  // s
  bool strict = false;
};

/// The clocks of a run in leapfrog steps.
struct LeapfrogTime : UniformTime {};

struct MpsCase {
  std::string title;
  ParticleRules particles;
  std::vector<ParticleRegion> regions;
  std::vector<Ground> materials;
  Damping damping;
  std::vector<Motion> motions;
  std::vector<SideBoundary> boundaries;
  LooseContact contact;
  GroundGravity gravity;
  Noise noise;
  std::vector<Gauge> gauges;
  UniformTime time;
  Output output;
};

}  // namespace sazare::cases
