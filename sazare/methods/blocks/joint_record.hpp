#pragma once

/// Bonded faces as records in memory, and several of them as lanes.

#include <array>
#include <cmath>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/rotation.hpp"
#include "sazare/core/time.hpp"

namespace sazare::methods::blocks {

/// A sheared joint has lost its cohesion by slip, and its faces are still pressed together: a crack under pressure.
enum class JointState : std::int16_t { intact, softening, broken, sheared };

/// Whether the faces of a joint are two bodies to whoever counts cracks and fragments.
inline bool is_crack(JointState state) { return state == JointState::broken || state == JointState::sheared; }

inline constexpr int vertex_count = 3;

/// One joint in memory, as small as it goes: a run waits for these records more than for anything. Lanes read it four numbers at
/// a time, in the order of its members. Places on the slave and areas are rounded to single precision, and everything else
/// follows what they have been rounded to: a joint is at rest, to round-off, as it was given.
struct alignas(64) JointRecord {
  struct Vertex {
    Vector3 corner = Vector3::Zero();  ///< a + u_0: from the master's centre, in face axes, with the slip so far [m]
    Real peak = 0;  ///< largest opening, at least the one that leaves it intact; of a natural joint its dilation [m]
  };

  Vector3 normal = Vector3::UnitX();  ///< of the face, out of the master, in its body frame
  Real tilt = 0;                      ///< gives the face's other axes, see face_axes
  std::array<Vertex, vertex_count> vertex;
  std::array<std::array<float, 3>, vertex_count> arm{};  ///< b: vertex from the slave's centre, in its body frame [m]
  std::int16_t kind = 0;  ///< its law's parameters, see JointKinds
  JointState state = JointState::intact;
  Index master = 0;
  Index slave = 0;
  float vertex_area = 0;  ///< A: a third of the face [m2]
  std::array<float, 3>
      spread{};  ///< S_yy, S_zz, S_yz: A times the sums over the vertices of y y, z z, y z from their middle [m4]

  Vector3 arm_of(std::size_t v) const { return {arm[v][0], arm[v][1], arm[v][2]}; }

  /// The double with which a vertex begins.
  static constexpr std::size_t vertex_begin(std::size_t v) { return 4 + 4 * v; }
};
static_assert(sizeof(JointRecord) == 24 * sizeof(Real));

/// The vertices of a face as points of its master, in the master's body frame, where the strain of the master moves them [m].
/// They are those of the beginning, whatever the joint has slipped, so that slip takes just the work of the shear stress.
struct alignas(32) MasterCorners {
  std::array<Vector3, vertex_count> vertex;
  std::array<Real, 3> unused{};
};
static_assert(sizeof(MasterCorners) == 12 * sizeof(Real));

/// What `face_axes` needs besides the normal.
inline Real face_tilt(const Vector3& normal) { return -1 / (std::copysign(1.0, normal.z()) + normal.z()); }

/// Face axes as columns: a unit normal and two tangents, to round-off at right angles. T. Duff and others: Building an
/// orthonormal basis, revisited. Journal of Computer Graphics Techniques 6(1), 2017.
template <class Vector, class Number>
std::array<Vector, 3> face_axes(const Vector& n, const Number& tilt) {
  const Number one = Number{} + 1.0, sign = select(tilt > 0.0, -one, one);
  const Number xt = n[0] * tilt, yt = n[1] * tilt, xyt = xt * n[1], signed_x = sign * n[0];
  return {n, Vector{{one + signed_x * xt, sign * xyt, -signed_x}}, Vector{{xyt, sign + n[1] * yt, -n[1]}}};
}

/// What a joint has dissipated.
struct JointLosses {
  Real slip_work = 0;  ///< by slip [J]
  Real released = 0;   ///< elastic energy when the face came apart [J]
  Real opening = 0;    ///< by fracture in opening, where the law softens by slip [J]
  Real shear = 0;      ///< by fracture in slip, where the law softens by slip [J]

  /// Whether slip has dissipated more of the fracture energy than opening.
  bool is_mostly_shear() const { return shear > opening; }
};

/// Path of slip of the vertices of a joint whose law remembers it [m].
using SlipPath = std::array<Real, vertex_count>;

/// Stress at the vertices of a face, across it with tension positive and along it, in face axes [Pa].
using FaceStress = std::array<Vector3, vertex_count>;

/// Joints in lanes; `Record` is a JointRecord, const or not. Each part is read where it is needed: all of it together would not
/// stay in registers. The pointers stay where they are: a copy of what has just been written one by one makes a processor wait
/// until all that came before is done.
template <class Record>
struct LaneJoints {
  const LanePointers<Record>& records;

  /// Q: face axes in the master's body frame.
  LaneMatrix frame() const {
    const auto numbers = load_quad(records, 0);
    return {face_axes(LaneVector{{numbers[0], numbers[1], numbers[2]}}, numbers[3])};
  }

  struct Vertex {
    LaneVector corner;
    Lanes peak;
  };
  Vertex vertex(std::size_t v) const {
    const auto numbers = load_quad(records, JointRecord::vertex_begin(v));
    return {{{numbers[0], numbers[1], numbers[2]}}, numbers[3]};
  }

  struct Tail {
    std::array<LaneVector, vertex_count> arm;
    Lanes vertex_area;
    std::array<Lanes, 3> spread;
  };
  Tail tail() const {
    const auto first = load_quad(records, 16), last = load_quad(records, 20);
    const auto a = unpack(first[0]), b = unpack(first[1]), c = unpack(first[2]), d = unpack(first[3]), e = unpack(last[0]);
    const auto f = unpack(last[2]), g = unpack(last[3]);
    return {{LaneVector{{a[0], a[1], b[0]}}, LaneVector{{b[1], c[0], c[1]}}, LaneVector{{d[0], d[1], e[0]}}},
            f[0],
            {f[1], g[0], g[1]}};
  }
};

}  // namespace sazare::methods::blocks
