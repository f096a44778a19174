#pragma once

#include "sazare/cases/tables.hpp"

/// A checked case of method rectangles, as plain data. All values in SI units; every member is one key of the case file.
namespace sazare::cases {

enum class BlockShape { rectangle, polygon, image };
enum class ElementShape { squares, circles, polygons };
enum class SpringLayout { centres, ends };
enum class IncrementFormula { small, exact };

struct SquareRules {
  Real thickness = 1;  // m
};

/// A block of squares on a lattice, of one rectangle, or of polygons around nuclei.
struct SquareBlock {
  std::string name;
  std::string material;
  BlockShape shape = BlockShape::rectangle;
  ElementShape elements = ElementShape::squares;
  Real element_size = 0;                    // m; 0: the rectangle is one element, or the nuclei are given
  std::filesystem::path nuclei;             // polygons
  std::vector<std::array<Real, 2>> places;  // m, of the nuclei in the file
  int seed = 1;                             // polygons without a file
  Vector3 lower = Vector3::Zero();          // m, rectangle and image
  Vector3 upper = Vector3::Zero();          // m, rectangle
  std::vector<std::array<Real, 2>> points;  // m, polygon
  std::filesystem::path file;               // image
  Real angle = 0;                           // deg, about `lower` or the first point
};

struct SquareMaterial {
  std::string name;
  Real density = 0;           // kg/m3
  Real normal_stiffness = 0;  // Pa; these two, or the next two
  Real shear_stiffness = 0;   // Pa
  Real youngs_modulus = 0;    // Pa; 0: the stiffnesses were given
  Real poisson_ratio = 0;
  Real damping_ratio = 0;
  Real tensile_strength = 0;  // Pa
  Real cohesion = 0;          // Pa
  Real friction_angle = 0;    // deg
  int springs = 5;
  SpringLayout layout = SpringLayout::centres;
  IncrementFormula increments = IncrementFormula::small;
};

struct SquareContact {
  Real normal_stiffness = 0;  // Pa
  Real shear_stiffness = 0;   // Pa
  Real damping_ratio = 0;
  Real friction_angle = 0;  // deg
};

/// A support stands, moves with a constant velocity, or as motions say.
struct SupportMotion {
  Vector3 velocity = Vector3::Zero();  // m/s
  std::array<std::string, 2> motion;   // names of motions by axis, or empty
};

struct Wall {
  std::string name;
  Vector3 from = Vector3::Zero();  // m
  Vector3 to = Vector3::Zero();    // m
  SupportMotion moves;
};

struct Roller {
  std::string name;
  Vector3 center = Vector3::Zero();  // m
  Real radius = 0;                   // m
  SupportMotion moves;
};

struct Plate {
  Real friction_coefficient = 0;
  Vector3 velocity = Vector3::Zero();  // m/s
  Real gravity = 9.81;                 // m/s2
};

struct RectanglesCase {
  std::string title;
  SquareRules elements;
  std::vector<SquareBlock> blocks;
  std::vector<SquareMaterial> materials;
  SquareContact contact;
  std::vector<Wall> walls;
  std::vector<Roller> rollers;
  std::vector<Motion> motions;
  Plate plate;
  Gravity gravity;
  std::vector<Gauge> gauges;
  LeapfrogTime time;
  Output output;
};

}  // namespace sazare::cases
