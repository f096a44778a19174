#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sazare/cases/soil/backbone.hpp"
#include "sazare/cases/tables.hpp"

/// A checked case of method mps, as plain data. All values in SI units; every member is one key of the case file.
namespace sazare::cases {

enum class ParticleFit { exact, inside };
enum class RotationRemoval { mean_rotation, mean_angle };
enum class RotationTorque { half, whole };
enum class EulerDamping { present, lagged };
enum class RegionShape { rectangle, polygon, mesh };
enum class Side { left, right, bottom, top, front, back, all };
enum class SideExtent { plane, surface };
enum class SideKind { fixed, roller, prescribed, viscous, free_field };

struct ParticleRules {
  Real spacing = 0;  // m
  int dimension = 2;
  Real influence = 1.5;  // over the spacing
  ParticleFit fit = ParticleFit::exact;
  std::array<bool, 3> periodic{false, false, false};
  RotationRemoval rotation = RotationRemoval::mean_rotation;
  RotationTorque rotation_torque = RotationTorque::half;
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

struct Ground : SoilBackbone {
  std::string name;
  std::vector<std::string> regions;
  Real density = 0;            // kg/m3
  Real s_wave_velocity = 0;     // m/s; of the three, two are given and the third follows
  Real p_wave_velocity = 0;  // m/s
  Real damping_ratio = 0;
  bool yields = false;        // whether it has a strength
  Real cohesion = 0;          // Pa
  Real friction_angle = 0;    // degrees
  Real dilation_angle = 0;    // degrees
  std::optional<Real> tensile_strength;  // Pa; without it the tip of the strength
  Real rupture_strain = 0;
  std::optional<Real> residual_cohesion;        // Pa; without it the cohesion stays
  std::optional<Real> residual_friction_angle;  // degrees; without it friction and dilation stay, with it dilation ends
  Real softening_displacement = 0;              // m

  Real residual_dilation_angle() const { return residual_friction_angle ? 0 : dilation_angle; }  // degrees
  bool softens() const {
    return yields &&
           (residual_cohesion.value_or(cohesion) < cohesion ||
            residual_friction_angle.value_or(friction_angle) < friction_angle || residual_dilation_angle() < dilation_angle);
  }
  Real shear_modulus() const { return density * s_wave_velocity * s_wave_velocity; }  // Pa
  bool fails() const { return yields || degrades; }
};

struct SideBoundary {
  Side side = Side::bottom;
  SideExtent extent = SideExtent::plane;
  std::string region;  // whose side; empty: of the body
  SideKind kind = SideKind::fixed;
  std::array<bool, 3> axes{false, false, false};  // of a roller; none: across the side
  std::array<std::string, 3> motion;              // names of motions by axis, or empty
};

struct GroundGravity : Gravity {
  bool settle = false;
  int max_settling_steps = 0;  // at most
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

struct MpsTime : UniformTime {
  EulerDamping euler_damping = EulerDamping::present;
};

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
  MpsTime time;
  Output output;
};

}  // namespace sazare::cases
