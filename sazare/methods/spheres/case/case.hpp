#pragma once

#include "sazare/cases/tables.hpp"
#include "sazare/cases/water/table.hpp"
#include "sazare/laws/granular/contact_laws.hpp"

/// A checked case of method spheres, as plain data. All values in SI units; every member is one key of the case file.
namespace sazare::cases {

using laws::ContactModel;

/// By parameter of the contact laws; those of other laws than the chosen one are not given.
using LawParameters = std::array<std::optional<Real>, laws::law_parameters.size()>;

enum class SphereSource { one, file, lattice, random, bodies };
enum class WallShape { plane, box, mesh };
enum class ClumpSource { tetrapod, file, mesh };
enum class SphereLevels { automatic, per_sphere, uniform };

struct Domain {
  std::array<bool, 3> periodic{false, false, false};
  Vector3 lower = Vector3::Zero();  // m, read along periodic axes
  Vector3 upper = Vector3::Zero();  // m
};

struct SphereMaterial {
  std::string name;
  Real density = 0;         // kg/m3
  Real youngs_modulus = 0;  // Pa, where the contact law needs it
  Real poisson_ratio = 0;   // where the contact law needs it
};

/// What pairs of materials have in common; what a [[pairs]] does not give is that of [contact].
struct GranularContact {
  ContactModel model = ContactModel::hertz;
  Real restitution = 1;
  Real friction_coefficient = 0;
  Real rolling_friction = 0;
  Real twisting_friction = 0;
  LawParameters law_parameters;
  Real overlap_limit = 0.05;  // of the smaller radius, at the start
  Real margin = 0.1;          // of the smallest diameter
};

struct MaterialPair {
  std::array<std::string, 2> between;
  std::optional<Real> restitution;
  std::optional<Real> friction_coefficient;
  std::optional<Real> rolling_friction;
  std::optional<Real> twisting_friction;
  LawParameters law_parameters;
};

/// A body made of spheres that may overlap, rigid or bonded.
struct ClumpShape {
  std::string name;
  ClumpSource source = ClumpSource::tetrapod;
  Real height = 0;             // m, tetrapod
  int leg_spheres = 4;         // tetrapod
  std::filesystem::path file;  // file: rows of radius, x, y, z; mesh: .stl or .msh
  Real scale = 1;              // the file's unit to m
  int count = 40;              // mesh
  std::string bonds;           // of [[bonds]] between neighbours, or empty for a rigid body
};

struct SphereGroup {
  std::string name;
  std::string material;
  SphereSource source = SphereSource::one;
  Vector3 centre = Vector3::Zero();    // m, one
  Real radius = 0;                     // m, one, lattice, random
  std::optional<Real> largest_radius;  // m, random
  std::filesystem::path file;          // rows of radius, x, y, z in m; of bodies with the body's number before them
  std::filesystem::path bodies_file;   // bodies
  Vector3 lower = Vector3::Zero();     // m, lattice, random
  Vector3 upper = Vector3::Zero();     // m, lattice, random
  std::optional<Real> spacing;         // m, lattice
  int count = 0;                       // random
  int seed = 1;                        // random
  Vector3 velocity = Vector3::Zero();  // m/s
  Vector3 spin = Vector3::Zero();      // rad/s
  Real noise = 0;                      // m/s, of every component
  std::string shape;                   // of [[shapes]], or empty for single spheres
  Vector3 rotation = Vector3::Zero();  // rad, of the shape at the start
  bool random_rotation = false;
  bool held = false;
  bool lowered = false;
  bool rain = false;
  std::optional<Real> drag_coefficient;     // with [water]
  std::optional<Real> inertia_coefficient;  // with [water]
};

struct WallRules {
  std::string name;
  std::string material;
  WallShape shape = WallShape::plane;
  Vector3 point = Vector3::Zero();    // m, plane
  Vector3 normal = Vector3::UnitZ();  // plane, towards the spheres
  Vector3 lower = Vector3::Zero();    // m, box
  Vector3 upper = Vector3::Zero();    // m, box
  std::filesystem::path file;         // mesh: .stl or .msh
  std::string group;                  // mesh: surface group of a .msh
  Real scale = 1;                     // mesh: file's unit to m
  std::array<std::string, 3> motion;  // names of motions by axis, or empty
  Vector3 spin = Vector3::Zero();     // rad/s
  Vector3 pivot = Vector3::Zero();    // m
};

/// Which spheres are bonded at the start, and how.
struct BondRules {
  std::string name;
  std::array<std::string, 2> between;    // groups, or empty where shapes name the entry
  Real reach = 0.01;                     // largest gap over the sum of the radii
  Real radius_ratio = 1;                 // over the smaller radius
  std::optional<Real> youngs_modulus;    // Pa
  std::optional<Real> poisson_ratio;     // with youngs_modulus
  std::optional<Real> normal_stiffness;  // Pa/m
  std::optional<Real> shear_stiffness;   // Pa/m
  Real damping_ratio = 0;                // of the critical damping
  std::optional<Real> tensile_strength;  // Pa
  std::optional<Real> cohesion;          // Pa
  Real friction_angle = 0;               // deg
  std::optional<Real> fracture_energy;   // N/m

  bool breaks() const { return tensile_strength.has_value() || cohesion.has_value(); }
};

/// A group whose centre of mass is recorded.
struct GroupGauge {
  std::string name;
  std::string group;
};

struct SphereTime : LeapfrogTime {
  SphereLevels levels = SphereLevels::automatic;
};

struct SpheresCase {
  std::string title;
  Domain domain;
  std::vector<SphereMaterial> materials;
  GranularContact contact;
  std::vector<MaterialPair> pairs;
  std::vector<ClumpShape> shapes;
  std::vector<SphereGroup> spheres;
  std::vector<BondRules> bonds;
  std::vector<WallRules> walls;
  std::vector<Motion> motions;
  Gravity gravity;
  Water water;
  std::vector<GroupGauge> gauges;
  SphereTime time;
  Output output;
};

}  // namespace sazare::cases
