#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real degree = 3.14159265358979323846 / 180;
const laws::Elasticity elastic{4e6, 6e6};

std::vector<laws::MohrCoulomb> strengths() {
  const Real none = std::numeric_limits<Real>::infinity();
  return {laws::MohrCoulomb::make(1e3, 0, 0, none), laws::MohrCoulomb::make(1e3, 0, 0, 500),
          laws::MohrCoulomb::make(1e3, 30 * degree, 30 * degree, 1e3 / std::tan(30 * degree)),
          laws::MohrCoulomb::make(1e3, 30 * degree, 10 * degree, 200), laws::MohrCoulomb::make(0, 35 * degree, 0, 0)};
}

Vector3 random_strain(std::mt19937& generator) {
  std::uniform_real_distribution<Real> uniform(-1e-3, 1e-3);
  Vector3 strain(uniform(generator), uniform(generator), uniform(generator));
  std::sort(strain.begin(), strain.end(), std::greater<>());
  return strain;
}

TEST(return_mapping, ends_on_or_within_the_strength_and_finds_what_sweeps_find) {
  std::mt19937 generator(1);
  for (const laws::MohrCoulomb& law : strengths()) {
    laws::MohrCoulomb swept = law;
    if (!std::isfinite(law.tensile_strength)) swept.tensile_strength = 1e6;
    const laws::PrincipalReturnMapping mapping(law, elastic);
    int yields = 0;
    for (int n = 0; n < 300; ++n) {
      const Vector3 strain = random_strain(generator);
      const auto found = mapping(strain);
      const Real small = 1e-6 * (law.cohesion + 1e3);
      for (int i = 0; i < 3; ++i) {
        EXPECT_LE(law.tension(found.stress[i]), small);
        for (int k = 0; k < 3; ++k) EXPECT_LE(i == k ? 0 : law.shear(found.stress[i], found.stress[k]), small);
      }
      const auto sweeps = laws::plastic_flow<3>(swept, elastic, {strain[0], strain[1], strain[2]});
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.plastic[static_cast<int>(i)], sweeps.strain[i], 1e-8);
      yields += found.yields ? 1 : 0;
    }
    EXPECT_GT(yields, 100);
  }
}

TEST(return_mapping, takes_no_energy_back) {
  std::mt19937 generator(2);
  for (const laws::MohrCoulomb& law : strengths())
    for (int n = 0; n < 200; ++n) {
      const auto found = laws::PrincipalReturnMapping(law, elastic)(random_strain(generator));
      EXPECT_GE(found.stress.dot(found.plastic), -1e-9);
    }
}

/// The tangent of the whole response, turned in space, against differences of the stress.
template <int D>
void check_tangent() {
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-1e-3, 1e-3);
  for (const laws::MohrCoulomb& law : strengths()) {
    const laws::PrincipalReturnMapping mapping(law, elastic);
    int good = 0, all = 0;
    for (int n = 0; n < 100; ++n) {
      Voigt<D> strain;
      for (int i = 0; i < stress_size<D>; ++i) strain[i] = uniform(generator);
      VoigtMatrix<D> tangent, differences;
      respond<D>(mapping, strain, &tangent);
      for (int i = 0; i < stress_size<D>; ++i) {
        const Voigt<D> step = 1e-9 * Voigt<D>::Unit(i);
        differences.col(i) = (respond<D>(mapping, Voigt<D>(strain + step), nullptr).stress -
                              respond<D>(mapping, Voigt<D>(strain - step), nullptr).stress) /
                             2e-9;
      }
      ++all;
      if ((tangent - differences).norm() < 1e-4 * 1e7) ++good;
    }
    EXPECT_GE(good, all - 2);  // the difference may step across an edge
  }
}

TEST(return_mapping, has_the_tangent_of_its_stress) {
  check_tangent<2>();
  check_tangent<3>();
}

TEST(return_mapping, does_not_depend_on_the_directions) {
  const laws::PrincipalReturnMapping mapping(strengths()[3], elastic);
  const Matrix3 turn = Eigen::AngleAxis<Real>(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const auto voigt = [](const Matrix3& e, Real shear) {
    Voigt<3> column;
    column << e(0, 0), e(1, 1), e(2, 2), shear * e(0, 1), shear * e(1, 2), shear * e(2, 0);
    return column;
  };
  const Matrix3 strain = Vector3(8e-4, -1e-4, -9e-4).asDiagonal();
  const Voigt<3> plain = respond<3>(mapping, voigt(strain, 2), nullptr).stress;
  const Voigt<3> turned = respond<3>(mapping, voigt(turn * strain * turn.transpose(), 2), nullptr).stress;
  const Matrix3 expected = turn * Vector3(plain.head<3>()).asDiagonal() * turn.transpose();
  EXPECT_NEAR((turned - voigt(expected, 1)).norm(), 0, 1e-7);
}

/// A square pressed between smooth plates in plane strain fails at 2 c tan(45 + phi/2).
TEST(yielding_body, fails_at_its_uniaxial_strength) {
  for (const ElementShape shape : {ElementShape::triangle6, ElementShape::quadrilateral4}) {
    const auto mesh = test::box(shape, {{1, 1, 1}, {2, 2, 1}, 0});
    SolidMaterial material = SolidMaterial::elastic_of(1e7, 0.3, 2000);
    material.strength = laws::MohrCoulomb::make(1e3, 30 * degree, 10 * degree, 100);
    Supports<2> supports;
    laws::GroundMotion motion;
    motion.shape = laws::GroundMotion::Shape::record;
    motion.quantity = laws::MotionQuantity::displacement;
    motion.record = laws::Record::make(1, {0, -1e-3});
    supports.motions = {motion};
    test::hold<2>(mesh, "left", 0, supports);
    test::hold<2>(mesh, "bottom", 1, supports);
    test::hold<2>(mesh, "top", 1, supports, 0);
    methods::fem::FemRules rules;
    rules.step = 0.1;
    rules.statics = true;
    methods::fem::FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, material)), supports, rules);
    stepper.start();
    for (int step = 0; step < 10; ++step) stepper.advance();
    Real force = 0;
    const auto reactions = stepper.reactions();
    for (const Support& support : supports.held)
      if (support.motion == 0) force -= reactions[static_cast<std::size_t>(support.node) * 2 + 1];
    EXPECT_NEAR(force, 2e3 * std::tan(60 * degree), 1e-6 * force);
    EXPECT_GT(stepper.work().plastic, 0);
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().boundary);
  }
}

/// Sand that contracts at a fixed volume loses its pressure, and when it is pressed together afterwards bears nothing until the
/// volume that cycles have taken is closed: the mean stress is K (e - lost), where that is positive.
TEST(contracting_sand, bears_again_when_what_cycles_have_taken_is_closed) {
  const laws::Elasticity stiffness{1e7, 1.5e7};
  const Real bulk = stiffness.lame + 2 * stiffness.shear_modulus / 3;
  const laws::CyclicContraction contraction(0.6, 0.7, 0);
  const StrengthAtPoint<3> law(laws::MohrCoulomb::make(0, 30 * degree, 0, std::nullopt), stiffness, contraction);
  std::vector<Real> before(law.memory_size(), 0), after(before);
  Voigt<3> strain = Voigt<3>::Zero();
  const auto volume = [&] { return -strain.head<3>().sum(); };
  const auto pressure = [&] { return -law.stress(strain, before).head<3>().mean(); };
  int compared = 0;
  const auto go = [&] {
    VoigtMatrix<3> tangent;
    law.respond(strain, before, after, &tangent);
    // The tangent is the derivative of the stress, but where that has a kink.
    for (int i = 0; i < 6; ++i) {
      std::vector<Real> other(after);
      Voigt<3> more = strain, less = strain;
      more[i] += 1e-7;
      less[i] -= 1e-7;
      const Voigt<3> up = law.respond(more, before, other, nullptr), here = law.respond(strain, before, other, nullptr),
                     down = law.respond(less, before, other, nullptr);
      if (((up - here) - (here - down)).norm() > 1e-3 * (up - down).norm() + 1e-4) continue;
      EXPECT_LT((tangent.col(i) - (up - down) / 2e-7).norm(), 1e-3 * 4e7) << i;
      ++compared;
    }
    before = after;
  };
  strain.head<3>().setConstant(-1e-4);
  law.begin_cycles(strain, before);
  Real lost = 0;
  for (int n = 1; n <= 200; ++n) {  // five cycles at the same volume
    strain[3] = 2e-3 * std::sin(2 * std::numbers::pi * n / 40);
    go();
    EXPECT_NEAR(pressure(), bulk * std::max(volume() - lost, Real{0}), 1e-6 * bulk) << n;
    lost = laws::CycleMemory<6>(std::span<const Real>(before).subspan(7)).lost();
  }
  EXPECT_GT(lost, 6e-4);
  for (int n = 0; n < 100; ++n) {
    strain.head<3>().array() -= 2e-5;
    go();
    EXPECT_NEAR(pressure(), bulk * std::max(volume() - lost, Real{0}), 1e-6 * bulk) << n;
  }
  EXPECT_GT(pressure(), 0.3 * bulk * volume());
  EXPECT_GT(compared, 700);  // of 1440
}

}  // namespace
}  // namespace sazare::methods::fem
