#pragma once

#include "sazare/cases/soil/backbone.hpp"
#include "sazare/cases/tables.hpp"

/// A checked case of method fem, as plain data. All values in SI units; every member is one key of the case file.
namespace sazare::cases {

enum class MassKind { consistent, lumped };
enum class IntegrationKind { full, reduced };
enum class GroupKind { fixed, roller, prescribed, viscous, free_field };
enum class Analysis { dynamic, statics };
enum class Drainage { drained, undrained, flow };
enum class AddedMass { none, westergaard };
enum class IncidentWaveKind { sv, sh, p };

struct FemMesh : Mesh {
  int dimension = 2;
};

struct FemElements {
  MassKind mass = MassKind::consistent;
  IntegrationKind integration = IntegrationKind::full;
};

struct FemMaterial : SoilBackbone {
  std::string name;
  std::vector<std::string> regions;
  Real density = 0;         // kg/m3
  Real youngs_modulus = 0;  // Pa
  Real poisson_ratio = 0;
  Real damping_ratio = 0;
  bool yields = false;                   // whether it has a strength
  Real cohesion = 0;                     // Pa
  Real friction_angle = 0;               // degrees
  Real dilation_angle = 0;               // degrees
  std::optional<Real> tensile_strength;  // Pa; without it the tip of the strength
  std::optional<Real> blow_count;        // (N1)60; with it or a rate cycles of shear take volume
  std::optional<Real> contraction_rate;  // C1
  Real contraction_threshold = 0;        // of the amplitude of shear strain
  std::optional<Real> water_table;  // m; without it the ground has no pore water
  Real saturated_density = 0;       // kg/m3, of the ground below
  Real pore_water_density = 0;      // kg/m3
  Drainage drainage = Drainage::drained;
  Real porosity = 0;
  Real water_bulk_modulus = 0;      // Pa
  Real hydraulic_conductivity = 0;  // m/s, of drainage "flow"

  bool contracts() const { return blow_count || contraction_rate; }
  Real shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }  // Pa
  Real constrained_modulus() const {                                                 // Pa
    return 2 * shear_modulus() * (1 - poisson_ratio) / (1 - 2 * poisson_ratio);
  }
};

/// A joint without thickness, between two regions or on a group of faces inside the body.
struct FemJoint {
  std::string name;
  std::array<std::string, 2> between;
  std::string group;
  Real normal_stiffness = 0;  // Pa/m
  Real shear_stiffness = 0;   // Pa/m
  Real cohesion = 0;          // Pa
  Real friction_angle = 0;    // degrees

  bool on_group() const { return !group.empty(); }
};

struct GroupBoundary {
  std::string group;
  GroupKind kind = GroupKind::fixed;
  std::array<bool, 3> axes{false, false, false};  // of a roller, and of what is prescribed besides the motions: held
  std::array<std::string, 3> motion;              // names of motions by axis, or empty
};

/// A plane wave from below, at an angle from the vertical.
struct FemIncidentWave {
  IncidentWaveKind kind = IncidentWaveKind::sv;
  std::string motion;  // empty where there is no wave
  Real angle = 0;      // degrees
  Real azimuth = 0;    // degrees

  bool is_there() const { return !motion.empty(); }
};

/// Two opposite sides that move alike.
struct FemTie {
  std::string group;
  std::string opposite;
};

struct FemLoad {
  std::string name;
  std::string group;
  Vector3 traction = Vector3::Zero();  // Pa
  Real ramp = 0;                       // s
};

/// Still water on outer faces, or in a joint.
struct FemWater {
  std::string name;
  std::string group;
  std::string joint;
  Real level = 0;                        // m
  std::optional<Real> far_level;         // m, at the other end of a base
  Vector3 direction = Vector3::UnitX();  // horizontal, from the end with the level to that with the far level
  Real density = 0;                      // kg/m3
  Real ramp = 0;                         // s
  AddedMass added_mass = AddedMass::none;
  std::optional<Real> bed;  // m; without it the lowest point of the group

  bool in_joint() const { return !joint.empty(); }
};

/// Faces at which the excess pore pressure is 0.
struct FemDrain {
  std::string group;
};

enum class FemMemberKind { beam, bar, spring, dashpot };

/// Beams, bars, springs or dashpots along the lines of a group, or from one node to another.
struct FemMember {
  std::string name;
  FemMemberKind kind = FemMemberKind::beam;
  std::string group;
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  // m
  Real youngs_modulus = 0;                               // Pa
  Real area = 0;                                         // m2
  Real second_moment = 0;                                // m4
  Real density = 0;                                      // kg/m3
  Real damping_ratio = 0;
  Real prestress = 0;  // N
  std::optional<Real> yield_force;        // N
  std::optional<Real> compression_force;  // N
  std::optional<Real> yield_moment;       // N m
  Real stiffness = 0;  // N/m
  Real damping = 0;    // N s/m
  Real spacing = 0;    // m, across the plane

  bool on_group() const { return !group.empty(); }
};

struct FemGravity : Gravity {
  bool settle = false;
};

struct FemSolver {
  Real tolerance = 0;
  int iterations = 0;
  int cuts = 0;
};

struct FemTime : UniformTime {
  Analysis analysis = Analysis::dynamic;
  Real alpha = 0;
};

struct FemCase {
  std::string title;
  FemMesh mesh;
  FemElements elements;
  std::vector<FemMaterial> materials;
  std::vector<FemJoint> joints;
  Damping damping;
  std::vector<Motion> motions;
  std::vector<GroupBoundary> boundaries;
  FemIncidentWave incident_wave;
  std::vector<FemTie> ties;
  std::vector<FemLoad> loads;
  std::vector<FemWater> waters;
  std::vector<FemDrain> drains;
  std::vector<FemMember> members;
  FemGravity gravity;
  FemSolver solver;
  std::vector<Gauge> gauges;
  FemTime time;
  Output output;
};

}  // namespace sazare::cases
