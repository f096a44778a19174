#pragma once

/// The joints of blocks as method `blocks` evaluates them while nothing breaks: geometry, springs, dashpots, forces in slots; see
/// methods/blocks/joint_kernel.hpp. All numbers stand in double precision, of which the engine keeps some in single precision.

#include <cmath>
#include <random>
#include <vector>

#include "benchmarks/lanes/back_ends.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"

namespace sazare::bench {

struct alignas(64) Body {
  Real number[24];  // place, rotation by columns, velocity, spin
};
struct alignas(64) Joint {
  Real number[32];  // normal and tilt; three times corner and peak; three arms, area and spread
};
struct alignas(64) JointSlot {
  Real number[16] = {};  // total: force, moment; the same of the dashpots
};

/// Blocks beside one another along a line of faces, slightly moved.
struct JointScene {
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<JointSlot> slots;
  std::vector<int> master, slave;

  explicit JointScene(int count) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<Real>(random()) / static_cast<Real>(std::mt19937::max()) - 0.5; };
    for (int i = 0; i < count; ++i) {
      Body body{};
      const auto put = [&](int begin, const Vector3& v) {
        for (int axis = 0; axis < 3; ++axis) body.number[begin + axis] = v[axis];
      };
      const Matrix3 rotation = Eigen::AngleAxis<Real>(1e-6 * number(), Vector3(1, 2, 3).normalized()).toRotationMatrix();
      put(0, Vector3(i + 1e-7 * number(), 1e-7 * number(), 1e-7 * number()));
      for (int axis = 0; axis < 3; ++axis) put(3 + 3 * axis, rotation.col(axis));
      put(12, Vector3(number(), number(), number()));
      put(15, Vector3(number(), number(), number()));
      bodies.push_back(body);
    }
    for (int i = 0; i + 1 < count; ++i)
      for (int twice = 0; twice < 2; ++twice) {
        Joint joint{};
        joint.number[0] = 1;
        joint.number[3] = -1;  // tilt of a normal along x
        constexpr Real y[3] = {-0.5, 0.5, 0}, z[3] = {-0.3, -0.3, 0.6};
        for (int v = 0; v < 3; ++v) {
          const Real corner[4] = {0.5, y[v], z[v], 1e-4}, arm[3] = {-0.5, 0, 0};
          for (int n = 0; n < 4; ++n) joint.number[4 + 4 * v + n] = corner[n];
          for (int n = 0; n < 3; ++n) joint.number[16 + 3 * v + n] = arm[n] + (n == 1 ? -z[v] : n == 2 ? y[v] : 0);
        }
        joint.number[25] = 0.15;
        joint.number[26] = 0.07;
        joint.number[27] = 0.08;
        joint.number[28] = 0.01;
        joints.push_back(joint);
        master.push_back(i);
        slave.push_back(i + 1);
      }
    const std::size_t whole = joints.size() / width * width;
    joints.resize(whole);
    slots.resize(whole);
  }
  std::size_t size() const { return joints.size(); }
};

template <class Ops>
class JointKernel {
  using N = Number<Ops>;
  using V = VectorOf<N>;
  using Matrix = std::array<V, 3>;

public:
  static constexpr const char* name = Ops::name;

  explicit JointKernel(JointScene& scene) : scene_(scene) {
    const auto tension = laws::JointTension::make(1e12, 1e7, 100);
    tension_ = {tension.stiffness, tension.strength, tension.elastic_opening, tension.failure_opening};
    shear_ = {N(5e11), N(1e9), N(0.6)};
  }

  void evaluate() {
    for (std::size_t n = 0; n < scene_.size(); n += width) evaluate(n);
  }

  Real check() const {
    Real sum = changes_;
    for (const JointSlot& slot : scene_.slots)
      for (const Real number : slot.number) sum += std::abs(number);
    return sum;
  }

private:
  static V transposed(const Matrix& m, const V& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
  static V product(const Matrix& m, const V& v) {
    V sum;
    for (int i = 0; i < 3; ++i) sum[i] = add_product(m[2][i], v[2], add_product(m[1][i], v[1], m[0][i] * v[0]));
    return sum;
  }
  template <class From>
  static std::array<N, 4> quad(const From& from, std::size_t begin) {
    const auto n = Ops::quads([&](std::size_t lane) { return from(lane) + begin; });
    return {N(n[0]), N(n[1]), N(n[2]), N(n[3])};
  }
  static V vector(const std::array<N, 4>& n) { return {n[0], n[1], n[2]}; }

  struct Places {
    V position;
    Matrix rotation;
  };
  template <class From>
  static Places places(const From& from) {
    const auto a = quad(from, 0), b = quad(from, 4), c = quad(from, 8);
    return {vector(a), {V{a[3], b[0], b[1]}, V{b[2], b[3], c[0]}, V{c[1], c[2], c[3]}}};
  }

  static void store(JointSlot* const slots, std::size_t begin, const V& force, const V& moment) {
    std::array<typename Ops::Vector, width> rows{force[0].v,  force[1].v,  force[2].v,        moment[0].v,
                                                 moment[1].v, moment[2].v, Ops::broadcast(0), Ops::broadcast(0)};
    Ops::transpose(rows);
    for (std::size_t lane = 0; lane < width; ++lane) Ops::store(slots[lane].number + begin, rows[lane]);
  }

  [[gnu::flatten, gnu::noinline]] void evaluate(std::size_t begin) {
    const auto joint = [&](std::size_t lane) { return scene_.joints[begin + lane].number; };
    const auto body = [&](const std::vector<int>& of) {
      return [&, this](std::size_t lane) { return scene_.bodies[static_cast<std::size_t>(of[begin + lane])].number; };
    };
    const auto masters = body(scene_.master), slaves = body(scene_.slave);
    // Face axes, and vertices in them.
    const auto normal = quad(joint, 0);
    const N one(1), tilt = normal[3], sign = select(tilt > N(), -one, one);
    const N xt = normal[0] * tilt, yt = normal[1] * tilt, xyt = xt * normal[1], signed_x = sign * normal[0];
    const Matrix frame{vector(normal), V{one + signed_x * xt, sign * xyt, -signed_x}, V{xyt, sign + normal[1] * yt, -normal[1]}};
    const Places m = places(masters);
    Matrix axes;
    for (std::size_t i = 0; i < 3; ++i) axes[i] = product(m.rotation, frame[i]);
    const Places s = places(slaves);
    const V between = s.position - m.position, apart = transposed(axes, between);
    Matrix slave_axes;
    for (std::size_t i = 0; i < 3; ++i) slave_axes[i] = transposed(axes, s.rotation[i]);
    const auto t0 = quad(joint, 16), t1 = quad(joint, 20), t2 = quad(joint, 24), t3 = quad(joint, 28);
    const std::array<V, 3> arm{vector(t0), V{t0[3], t1[0], t1[1]}, V{t1[2], t1[3], t2[0]}};
    const N area = t2[1], yy = t2[2], zz = t2[3], yz = t3[0];
    std::array<V, 3> point, offset;
    std::array<N, 3> peak;
    for (std::size_t v = 0; v < 3; ++v) {
      point[v] = add_product(arm[v][2], slave_axes[2],
                             add_product(arm[v][1], slave_axes[1], add_product(arm[v][0], slave_axes[0], apart)));
      const auto vertex = quad(joint, 4 + 4 * v);
      offset[v] = point[v] - vector(vertex);
      peak[v] = vertex[3];
    }
    // Springs.
    std::array<N, 3> stress;
    bool changes = false;
    N most, least;
    for (std::size_t v = 0; v < 3; ++v) {
      stress[v] = tension_.stiffness * offset[v][0];
      changes |= any_above(offset[v][0], peak[v]);
      const N strength = laws::shear_strength(shear_, stress[v]);
      const laws::Slip<N> slip{{offset[v][1], offset[v][2]}, {N(), N()}, N()};
      changes |= any(laws::slips(shear_, slip, strength));
    }
    if (changes) ++changes_;
    const N minus_area = -area, shear_area = minus_area * shear_.stiffness;
    V force, moment;
    for (std::size_t v = 0; v < 3; ++v) {
      const V at_point{minus_area * stress[v], shear_area * offset[v][1], shear_area * offset[v][2]};
      force = force + at_point;
      moment = add_cross(point[v], at_point, moment);
    }
    // Dashpots.
    const auto m4 = quad(masters, 12), m5 = quad(masters, 16), s4 = quad(slaves, 12), s5 = quad(slaves, 16);
    const V slave_spin{s4[3], s5[0], s5[1]}, master_spin{m4[3], m5[0], m5[1]};
    const V spin = transposed(axes, slave_spin - master_spin),
            velocity = transposed(axes, add_cross(between, slave_spin, vector(s4) - vector(m4)));
    const N across = N(-2e3), along = N(-1e3);
    const V sum = point[0] + point[1] + point[2], swept = cross(spin, sum);
    const N across_area = across * area, along_area = along * area;
    const V thrice = add_product(N(3), velocity, swept);
    const V drag{across_area * thrice[0], along_area * thrice[1], along_area * thrice[2]};
    const V about_middle{along * ((yy + zz) * spin[0]), across * (zz * spin[1] - yz * spin[2]),
                         across * (yy * spin[2] - yz * spin[1])};
    const V drag_moment = add_product(N(1.0 / 3), cross(sum, drag), about_middle);
    // To world axes.
    const auto deliver = [&](std::size_t number, const V& f, const V& about_master) {
      const V world = product(axes, f);
      store(&scene_.slots[begin], number, world, add_cross(m.position, world, product(axes, about_master)));
    };
    deliver(0, force + drag, moment + drag_moment);
    deliver(8, drag, drag_moment);
  }

  JointScene& scene_;
  laws::TensionParameters<N> tension_;
  laws::ShearParameters<N> shear_;
  int changes_ = 0;
};

}  // namespace sazare::bench
