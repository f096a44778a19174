#include "sazare/laws/soil/overlay_plasticity.hpp"

#include <gtest/gtest.h>

#include <random>

#include <Eigen/Geometry>

namespace sazare::laws {
namespace {

constexpr Real modulus = 4e7, reference = 1e-3, strength = modulus * reference;
const Elasticity elastic{modulus, 6e7};
const BackboneCurve curve = hyperbolic_curve(modulus, reference, strength, 30);

/// A point that is led along a path, with the work done on it.
template <int N>
struct Sample {
  using Column = OverlayModel<N>::Column;

  OverlayModel<N> law{elastic, curve};
  Column strain = Column::Zero(), stress = Column::Zero();
  std::vector<Real> memory = std::vector<Real>(law.memory_size(), 0);
  Real work = 0, end_work = 0, plastic = 0, least_plastic = 0;  ///< [J/m3]

  void move_to(const Column& next) {
    std::vector<Real> after(memory.size());
    const Column found = law.respond(next, memory, after, nullptr);
    const Real flow = law.energies(strain, next, memory, after).plastic;
    work += 0.5 * (found + stress).dot(next - strain);
    end_work += found.dot(next - strain);
    plastic += flow;
    least_plastic = std::min(least_plastic, flow);
    strain = next, stress = found, memory = after;
  }
  Real elastic_energy() const { return law.energies(strain, strain, memory, memory).elastic; }
};

/// A deviatoric strain of shear strain 1, in any direction.
template <int N>
Sample<N>::Column direction(std::mt19937& generator) {
  std::normal_distribution<Real> normal;
  typename Sample<N>::Column way;
  for (Real& part : way) part = normal(generator);
  way.template head<3>().array() -= way.template head<3>().mean();
  return way / OverlayModel<N>::shear_of(way);
}

template <int N>
Sample<N>::Column random_strain(std::mt19937& generator, Real most) {
  std::uniform_real_distribution<Real> uniform(-most, most);
  typename Sample<N>::Column strain;
  for (Real& part : strain) part = uniform(generator);
  return strain;
}

/// In whatever direction, the stress is along the strain: t/|e'| times the tensor's parts of it.
template <int N>
void check_first_loading() {
  std::mt19937 generator(1);
  for (int n = 0; n < 20; ++n) {
    const auto way = direction<N>(generator);
    Sample<N> sample;
    for (const Real strain : spaced_strains(0.02 * reference, 50 * reference, 30)) {
      sample.move_to(strain * way);
      auto expected = way;
      expected.template tail<N - 3>() /= 2;
      EXPECT_NEAR((sample.stress - 2 * curve.stress(strain) * expected).norm(), 0, 1e-11 * strength);
    }
  }
}

TEST(overlay_model, follows_the_backbone_in_any_direction) {
  check_first_loading<4>();
  check_first_loading<6>();
}

TEST(overlay_model, is_elastic_at_small_strain) {
  Sample<6> sample;
  Sample<6>::Column strain;
  strain << 1e-7, -2e-7, 4e-7, 1e-7, 2e-7, -3e-7;
  sample.move_to(strain);
  const Real volume = strain.head<3>().sum();
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(sample.stress[i], i < 3 ? 2 * modulus * strain[i] + elastic.lame * volume : modulus * strain[i],
                1e-12 * modulus * 1e-7);
  EXPECT_EQ(sample.law.slip(sample.memory), 0);
}

TEST(overlay_model, gives_all_of_the_volume_back) {
  Sample<4> sample;
  sample.move_to(Sample<4>::Column(0.01, 0.01, 0.01, 0));
  EXPECT_NEAR(sample.stress[0], (3 * elastic.lame + 2 * modulus) * 0.01, 1e-3);
  EXPECT_EQ(sample.plastic, 0);
}

/// The loop between -a and a: its branches are the backbone at twice its size, and its area is 8 (A - W).
template <int N>
void check_cycle(Real a) {
  std::mt19937 generator(3);
  const auto way = direction<N>(generator);
  Sample<N> sample;
  sample.move_to(a * way);
  const auto branch = [&](Real from, Real to) {
    const Real sign = to > from ? 1 : -1, start = sample.stress.dot(way);
    for (const Real corner : curve.corner_strain()) {
      if (2 * corner >= 2 * a) break;
      sample.move_to((from + sign * 2 * corner) * way);
      EXPECT_NEAR(sample.stress.dot(way), start + sign * 2 * curve.stress(corner), 1e-10 * strength);
    }
    sample.move_to(to * way);
  };
  branch(a, -a);
  const Real work = sample.work, plastic = sample.plastic;
  branch(-a, a);
  branch(a, -a);
  const Real loop = 8 * (curve.area(a) - 0.5 * a * curve.stress(a));
  EXPECT_NEAR(sample.work - work, loop, 1e-9 * loop);
  EXPECT_NEAR(sample.plastic - plastic, loop, 1e-9 * loop);
  const Real x = a / reference, exact = 8 * modulus * reference * reference * (x - std::log1p(x) - 0.5 * x * x / (1 + x));
  EXPECT_NEAR(loop, exact, 0.02 * exact);
}

TEST(overlay_model, obeys_masings_rules_in_closed_cycles) {
  for (const Real a : {0.3e-3, 1e-3, 3e-3, 1e-2}) {
    check_cycle<4>(a);
    check_cycle<6>(a);
  }
}

/// A small loop in a large one closes, and the large branch goes on as if it had not been: the memory of soil.
TEST(overlay_model, goes_on_along_the_outer_branch_after_a_small_loop) {
  Sample<4> plain, looped;
  const Sample<4>::Column way = Sample<4>::Column::Unit(3);
  for (Sample<4>* sample : {&plain, &looped}) {
    sample->move_to(3e-3 * way);
    sample->move_to(-1e-3 * way);
  }
  const auto before = looped.stress;
  looped.move_to(0.5e-3 * way);
  looped.move_to(-1e-3 * way);
  EXPECT_NEAR((looped.stress - before).norm(), 0, 1e-10 * strength);
  for (Sample<4>* sample : {&plain, &looped}) sample->move_to(-2e-3 * way);
  EXPECT_NEAR((looped.stress - plain.stress).norm(), 0, 1e-10 * strength);
}

template <int N>
void check_energies() {
  std::mt19937 generator(4);
  for (int n = 0; n < 30; ++n) {
    Sample<N> sample;
    for (int leg = 0; leg < 40; ++leg) {
      sample.move_to(random_strain<N>(generator, leg % 2 == 0 ? 5e-3 : 2e-4));
      EXPECT_NEAR(sample.work, sample.elastic_energy() + sample.plastic, 1e-12 * (1 + std::abs(sample.work)));
    }
    EXPECT_GE(sample.least_plastic, -1e-12);
    EXPECT_GT(sample.plastic, 0);
  }
}

TEST(overlay_model, work_is_what_is_stored_and_what_is_dissipated) {
  check_energies<4>();
  check_energies<6>();
}

/// With the stress at the end of each step, for which the inequality holds step by step.
template <int N>
void check_closed_paths() {
  std::mt19937 generator(5);
  for (int n = 0; n < 100; ++n) {
    Sample<N> sample;
    for (int leg = 0; leg < 5; ++leg) sample.move_to(random_strain<N>(generator, 4e-3));
    const auto start = sample.strain;
    sample.end_work = 0;
    for (int leg = 0; leg < 1 + n % 8; ++leg) sample.move_to(start + random_strain<N>(generator, n % 3 == 0 ? 1e-4 : 3e-3));
    sample.move_to(start);
    EXPECT_GE(sample.end_work, -1e-11);
  }
}

TEST(overlay_model, gains_nothing_on_closed_paths_from_any_state) {
  check_closed_paths<4>();
  check_closed_paths<6>();
}

TEST(overlay_model, has_the_stress_of_its_energy) {
  std::mt19937 generator(6);
  Sample<6> sample;
  for (int leg = 0; leg < 5; ++leg) sample.move_to(random_strain<6>(generator, 3e-3));
  for (int i = 0; i < 6; ++i) {
    const Sample<6>::Column step = 1e-6 * Sample<6>::Column::Unit(i);
    const auto energy = [&](const Sample<6>::Column& strain) {
      return sample.law.energies(strain, strain, sample.memory, sample.memory).elastic;
    };
    EXPECT_NEAR((energy(sample.strain + step) - energy(sample.strain - step)) / 2e-6, sample.stress[i], 1e-6 * strength);
  }
  EXPECT_NEAR((sample.law.stress(sample.strain, sample.memory) - sample.stress).norm(), 0, 1e-10 * strength);
}

template <int N>
void check_tangent() {
  std::mt19937 generator(7);
  Sample<N> sample;
  for (int n = 0; n < 100; ++n) {
    sample.move_to(random_strain<N>(generator, 3e-3));
    const auto next = random_strain<N>(generator, 3e-3);
    std::vector<Real> after(sample.memory.size());
    typename OverlayModel<N>::Square tangent, differences;
    sample.law.respond(next, sample.memory, after, &tangent);
    for (int i = 0; i < N; ++i) {
      const typename Sample<N>::Column step = 1e-9 * Sample<N>::Column::Unit(i);
      differences.col(i) = (sample.law.respond(next + step, sample.memory, after, nullptr) -
                            sample.law.respond(next - step, sample.memory, after, nullptr)) /
                           2e-9;
    }
    EXPECT_NEAR((tangent - differences).norm(), 0, 1e-5 * modulus);
    EXPECT_NEAR((tangent - tangent.transpose()).norm(), 0, 1e-12 * modulus);
    EXPECT_GT(tangent.ldlt().vectorD().minCoeff(), 0);
  }
}

TEST(overlay_model, has_the_symmetric_tangent_of_its_stress) {
  check_tangent<4>();
  check_tangent<6>();
}

Sample<6>::Column turned(const Sample<6>::Column& column, const Matrix3& turn, Real shear) {
  Matrix3 tensor = column.head<3>().asDiagonal();
  tensor(0, 1) = tensor(1, 0) = column[3] / shear;
  tensor(1, 2) = tensor(2, 1) = column[4] / shear;
  tensor(2, 0) = tensor(0, 2) = column[5] / shear;
  const Matrix3 now = turn * tensor * turn.transpose();
  Sample<6>::Column result;
  result << now(0, 0), now(1, 1), now(2, 2), shear * now(0, 1), shear * now(1, 2), shear * now(2, 0);
  return result;
}

TEST(overlay_model, does_not_depend_on_the_axes) {
  std::mt19937 generator(8);
  const Matrix3 turn = Eigen::AngleAxis<Real>(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  Sample<6> plain, other;
  for (int leg = 0; leg < 30; ++leg) {
    const auto strain = random_strain<6>(generator, 3e-3);
    plain.move_to(strain);
    other.move_to(turned(strain, turn, 2));
    EXPECT_NEAR((turned(plain.stress, turn, 1) - other.stress).norm(), 0, 1e-9 * strength);
    EXPECT_NEAR(plain.plastic, other.plastic, 1e-12 * (1 + plain.plastic));
  }
}

/// Plane strain is the same law.
TEST(overlay_model, in_the_plane_is_the_one_in_space) {
  std::mt19937 generator(9);
  Sample<4> flat;
  Sample<6> full;
  for (int leg = 0; leg < 30; ++leg) {
    auto strain = random_strain<4>(generator, 3e-3);
    strain[2] = 0;
    Sample<6>::Column same = Sample<6>::Column::Zero();
    same.head<4>() = strain;
    flat.move_to(strain);
    full.move_to(same);
    EXPECT_NEAR((full.stress.head<4>() - flat.stress).norm() + full.stress.tail<2>().norm(), 0, 1e-10 * strength);
  }
}

TEST(overlay_model, remembers_its_largest_shear_strain_and_its_flow) {
  Sample<4> sample;
  const Sample<4>::Column way = Sample<4>::Column::Unit(3);
  sample.move_to(1e-2 * way);
  EXPECT_NEAR(sample.law.slip(sample.memory), 1e-2 - curve.stress(1e-2) / modulus, 1e-14);
  sample.move_to(-2e-3 * way);
  EXPECT_EQ(sample.law.peak(sample.memory), 1e-2);
}

}  // namespace
}  // namespace sazare::laws
