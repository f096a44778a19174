#pragma once

/// The contacts of spheres as method `spheres` evaluates them, cut down to one kind of contact: Hertz-Mindlin without rolling,
/// one material, no periodic sides, all pairs touch. Passes, law and memory are those of methods/spheres/contact_kernel.hpp.

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "benchmarks/lanes/back_ends.hpp"
#include "sazare/laws/granular_contact.hpp"

namespace sazare::bench {

struct alignas(64) Place {
  Real x, y, z, radius, vx, vy, vz, mass;
};
struct alignas(32) Spin {
  Real x, y, z, material;
};
struct alignas(64) Load {
  Real number[8] = {};
};

/// A block of spheres on a lattice that overlap a little with their neighbours along the axes.
struct ContactScene {
  std::vector<Place> places;
  std::vector<Spin> spins;
  std::vector<Load> loads;
  std::vector<int> first, second;
  laws::ContactConstants<Real> constants =
      laws::hertz_constants({1e8, 0.25}, {1e8, 0.25}, 0.6, {.sliding = 0.4, .rolling = 0, .twisting = 0});
  Real step = 2e-6;

  explicit ContactScene(int edge) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<Real>(random()) / static_cast<Real>(std::mt19937::max()) - 0.5; };
    const auto at = [&](int i, int j, int k) { return (i * edge + j) * edge + k; };
    for (int i = 0; i < edge; ++i)
      for (int j = 0; j < edge; ++j)
        for (int k = 0; k < edge; ++k) {
          const Real spacing = 0.998e-3, shake = 1e-6;
          places.push_back({spacing * i + shake * number(), spacing * j + shake * number(), spacing * k + shake * number(), 5e-4,
                            0.1 * number(), 0.1 * number(), 0.1 * number(), 1.3e-6});
          spins.push_back({10 * number(), 10 * number(), 10 * number(), 0});
          for (const auto& [di, dj, dk] : {std::array{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
            if (i + di < edge && j + dj < edge && k + dk < edge) {
              first.push_back(at(i, j, k));
              second.push_back(at(i + di, j + dj, k + dk));
            }
        }
    loads.resize(places.size());
    const std::size_t whole = first.size() / 32 * 32;
    first.resize(whole);
    second.resize(whole);
  }
  std::size_t size() const { return first.size(); }
};

template <class Ops>
class ContactKernel {
  using One = Number<Ops>;
  using Two = Twins<Ops>;
  using TwoVector = VectorOf<Two>;
  static constexpr std::size_t in_group = 2 * width, groups = 2;

public:
  static constexpr const char* name = Ops::name;

  explicit ContactKernel(ContactScene& scene) : scene_(scene), sliding_(scene.size() / in_group) {
    const auto& c = scene.constants;
    constants_ = {c.normal, c.tangential, c.normal_damping, c.tangential_damping, c.friction, c.rolling, c.twisting, c.adhesion};
    for (auto& some : sliding_) some = TwoVector{};
  }

  void evaluate() {
    for (std::size_t n = 0; n < scene_.size(); n += groups * in_group) {
      for (std::size_t g = 0; g < groups; ++g) groups_[g].begin = n + g * in_group;
      meet();
      turn();
      press();
      deliver();
    }
  }

  /// Sums that tell whether back ends agree.
  Real check() const {
    Real sum = 0;
    for (const Load& load : scene_.loads)
      for (const Real number : load.number) sum += std::abs(number);
    return sum;
  }

private:
  struct Group {
    std::size_t begin;
    laws::ContactMotion<Two> at;
    Two first_arm, second_arm;
    TwoVector force, moment_by_arm;
  };
  struct Meeting {
    std::array<One, 8> apart, first, second;
  };

  Meeting meeting(std::size_t begin) const {
    std::array<typename Ops::Vector, width> one, other, apart;
    for (std::size_t lane = 0; lane < width; ++lane) {
      one[lane] = Ops::load(&scene_.places[static_cast<std::size_t>(scene_.first[begin + lane])].x);
      other[lane] = Ops::load(&scene_.places[static_cast<std::size_t>(scene_.second[begin + lane])].x);
      apart[lane] = other[lane] - one[lane];
    }
    Ops::transpose(one);
    Ops::transpose(other);
    Ops::transpose(apart);
    Meeting all;
    for (std::size_t i = 0; i < 8; ++i) {
      all.apart[i] = apart[i];
      all.first[i] = one[i];
      all.second[i] = other[i];
    }
    return all;
  }

  [[gnu::flatten, gnu::noinline]] void meet() {
    for (Group& group : groups_) {
      const Meeting a = meeting(group.begin), b = meeting(group.begin + width);
      const auto apart = [&](std::size_t i) { return Two(a.apart[i], b.apart[i]); };
      const Two radius(a.first[3], b.first[3]), second_radius(a.second[3], b.second[3]);
      auto& at = group.at;
      at.radius = {radius * second_radius, radius + second_radius};
      const Two mass(a.first[7], b.first[7]), second_mass(a.second[7], b.second[7]);
      at.mass = {mass * second_mass, mass + second_mass};
      const TwoVector way{apart(0), apart(1), apart(2)};
      const Two square = dot(way, way), inverse = inverse_square_root(square);
      at.normal = inverse * way;
      at.overlap = maximum(-add_product(square, inverse, -at.radius.sum), Two(1e-30));
      const Two deep = Two(0.5) * at.overlap;
      group.first_arm = radius - deep;
      group.second_arm = second_radius - deep;
      at.velocity = {apart(4), apart(5), apart(6)};
    }
  }

  VectorOf<One> spins(std::size_t begin, const One& a, const One& b) const {
    const auto of = [&](const std::vector<int>& which) {
      const auto n = Ops::quads(
          [&](std::size_t lane) { return &scene_.spins[static_cast<std::size_t>(which[begin + lane])].x; });
      return VectorOf<One>{One(n[0]), One(n[1]), One(n[2])};
    };
    return add_product(b, of(scene_.second), a * of(scene_.first));
  }

  [[gnu::flatten, gnu::noinline]] void turn() {
    for (Group& group : groups_) {
      const auto a = spins(group.begin, group.first_arm.first, group.second_arm.first),
                 b = spins(group.begin + width, group.first_arm.second, group.second_arm.second);
      const TwoVector turning{Two(a[0], b[0]), Two(a[1], b[1]), Two(a[2], b[2])};
      group.at.velocity = group.at.velocity - cross(turning, group.at.normal);
    }
  }

  [[gnu::flatten, gnu::noinline]] void press() {
    for (Group& group : groups_) {
      laws::ContactMemory<Two> memory;
      memory.sliding = sliding_[group.begin / in_group];
      group.at.step = scene_.step;
      const auto force = laws::contact_force<laws::Hertz, false, false>(constants_, group.at, memory);
      sliding_[group.begin / in_group] = memory.sliding;
      group.force = add_product(force.normal, group.at.normal, force.friction);
      group.moment_by_arm = cross(force.friction, group.at.normal);
      work_ += force.dashpot_power + force.sliding_power;
    }
  }

  void deliver(std::size_t begin, const VectorOf<One>& force, const VectorOf<One>& moment, const One& first_arm,
               const One& second_arm) {
    std::array<typename Ops::Vector, width> rows{force[0].v,  force[1].v,  force[2].v,  Ops::broadcast(0),
                                                 moment[0].v, moment[1].v, moment[2].v, Ops::broadcast(0)};
    Ops::transpose(rows);
    alignas(64) Real arm[2][width];
    Ops::store(arm[0], first_arm.v);
    Ops::store(arm[1], second_arm.v);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto add = [&](int sphere, Real share, Real own_arm) {
        alignas(64) const Real factors[width] = {share, share, share, share, own_arm, own_arm, own_arm, own_arm};
        Real* const to = scene_.loads[static_cast<std::size_t>(sphere)].number;
        Ops::store(to, Ops::add_product(Ops::load(factors), rows[lane], Ops::load(to)));
      };
      add(scene_.first[begin + lane], -1, arm[0][lane]);
      add(scene_.second[begin + lane], 1, arm[1][lane]);
    }
  }

  [[gnu::flatten, gnu::noinline]] void deliver() {
    for (const Group& group : groups_) {
      const auto half = [](const TwoVector& of, One Two::*part) {
        return VectorOf<One>{of[0].*part, of[1].*part, of[2].*part};
      };
      for (std::size_t n = 0; n < 2; ++n) {
        One Two::*const part = n == 0 ? &Two::first : &Two::second;
        deliver(group.begin + n * width, half(group.force, part), half(group.moment_by_arm, part), group.first_arm.*part,
                group.second_arm.*part);
      }
    }
  }

  ContactScene& scene_;
  laws::ContactConstants<Two> constants_;
  std::vector<TwoVector> sliding_;
  std::array<Group, groups> groups_;
  Two work_;
};

}  // namespace sazare::bench
