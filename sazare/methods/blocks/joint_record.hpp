#pragma once

/// Bonded faces as records in memory, and several of them as lanes.

#include <array>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/rotation.hpp"
#include "sazare/core/time.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"

namespace sazare::methods::blocks {

enum class JointState : std::int16_t { intact, softening, broken };

/// Strength and stiffness of a kind of joint; `P` as in the laws.
template <class P>
struct JointParameters {
  laws::TensionParameters<P> tension;
  laws::ShearParameters<P> shear;
  P normal_damping{};  ///< c_n [Pa s/m]
  P shear_damping{};   ///< c_s [Pa s/m]
};

using JointKind = JointParameters<Real>;

inline constexpr int vertex_count = 3;

/// One joint in memory, as small as it goes: a run waits for these records more than for anything. Lanes read it four numbers at
/// a time, in the order of its members. Places on the slave, the face's axes and slips are rounded to single precision, and
/// everything else follows what they have been rounded to: a joint is at rest, to round-off, as it was given.
struct alignas(64) JointRecord {
  struct Vertex {
    Vector3 corner = Vector3::Zero();  ///< a: from the master's centre, in face axes [m]
    std::array<float, 2> slip{};       ///< u_0 [m]
  };

  std::array<float, 4> axes{};  ///< quaternion x, y, z, w, its length any: Q in the master's body frame
  Real vertex_area = 0;         ///< A: a third of the face [m2]
  Index master = 0;
  Index slave = 0;
  std::array<Vertex, vertex_count> vertex;
  std::array<std::array<float, 3>, vertex_count> arm{};  ///< b: vertex from the slave's centre, in its body frame [m]
  std::int16_t kind = 0;
  JointState state = JointState::intact;
  std::array<Real, vertex_count> peak{};  ///< by vertex: largest opening, at least the elastic one [m]

  /// Q: face axes (normal out of the master, two tangents) in its body frame, columns.
  Matrix3 frame() const { return Quaternion(axes[3], axes[0], axes[1], axes[2]).normalized().toRotationMatrix(); }
  Vector3 arm_of(std::size_t v) const { return {arm[v][0], arm[v][1], arm[v][2]}; }
};
static_assert(sizeof(JointRecord) == 24 * sizeof(Real));

/// What a joint has taken for good.
struct JointLosses {
  Real slip_work = 0;  ///< [J]
  Real released = 0;   ///< elastic energy when the face came apart [J]
};

/// Joints in lanes; `Record` is a JointRecord, const or not. Each part is read where it is needed: all of it together would not
/// stay in registers.
template <class Record>
struct LaneJoints {
  LanePointers<Record> records;

  struct Head {
    LaneMatrix frame;
    Lanes vertex_area;
  };
  Head head() const {
    const auto numbers = load_quad(records, 0);
    const auto [x, y] = unpack(numbers[0]);
    const auto [z, w] = unpack(numbers[1]);
    return {rotation_of(2.0 / (x * x + y * y + z * z + w * w), x, y, z, w), numbers[2]};
  }

  struct Vertex {
    LaneVector corner;
    std::array<Lanes, 2> slip;
  };
  Vertex vertex(std::size_t v) const {
    const auto numbers = load_quad(records, 4 + 4 * v);
    return {{{numbers[0], numbers[1], numbers[2]}}, unpack(numbers[3])};
  }

  struct Tail {
    std::array<LaneVector, vertex_count> arm;
    LaneVector peak;
  };
  Tail tail() const {
    const auto first = load_quad(records, 16), last = load_quad(records, 20);
    const auto a = unpack(first[0]), b = unpack(first[1]), c = unpack(first[2]), d = unpack(first[3]), e = unpack(last[0]);
    return {{LaneVector{{a[0], a[1], b[0]}}, LaneVector{{b[1], c[0], c[1]}}, LaneVector{{d[0], d[1], e[0]}}},
            {{last[1], last[2], last[3]}}};
  }
};

}  // namespace sazare::methods::blocks
