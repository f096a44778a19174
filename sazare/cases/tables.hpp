#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sazare/core/vector.hpp"
#include "sazare/laws/ground_motion.hpp"

/// Tables that several methods share, as plain data. All values in SI units; files as paths that can be opened from anywhere.
/// Every member is one key of the case file; the schemas list them with unit, range and default.
namespace sazare::cases {

enum class MotionShape { ricker, sine, record, function };
enum class Baseline { none, constant, linear };
enum class Integrator { verlet, leapfrog, euler };

struct Mesh {
  std::filesystem::path file;                            // .msh (Gmsh 4.1) or .geo
  Real scale = 1.0;                                      // factor on coordinates
  Real size_factor = 1.0;                                // .geo only: gmsh -clscale
  std::vector<std::pair<std::string, Real>> parameters;  // .geo only: gmsh -setnumber NAME VALUE
  bool is_geometry() const { return file.extension() == ".geo"; }
};

struct Damping {
  Real f1 = 0;  // Hz
  Real f2 = 0;  // Hz
  bool relative_to_base = true;
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

struct Gravity {
  Vector3 acceleration = Vector3::Zero();  // m/s2
};

struct Gauge {
  std::string name;
  Vector3 point = Vector3::Zero();  // m
};

/// The clocks of a run whose bodies all have the same step.
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

struct Output {
  Real checkpoint_interval = 60;  // s of wall clock
};

}  // namespace sazare::cases
