#include "sazare/laws/ground_motion.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace sazare::laws {
namespace {

/// Velocity is the slope of the displacement, acceleration that of the velocity.
void expect_consistent(const GroundMotion& motion, Real time, Real scale) {
  constexpr Real small = 1e-5;
  const MotionState before = motion.at(time - small), now = motion.at(time), after = motion.at(time + small);
  EXPECT_NEAR((after.displacement - before.displacement) / (2 * small), now.velocity, 1e-6 * scale) << time;
  EXPECT_NEAR((after.velocity - before.velocity) / (2 * small), now.acceleration, 1e-5 * scale) << time;
}

TEST(ground_motion, ricker_has_the_values_of_its_formula) {
  const Ricker wave{4, 0.25};
  EXPECT_DOUBLE_EQ(ricker(wave, 0.25), -1);
  const Real zero = 0.25 + 1 / (std::sqrt(2.0) * std::numbers::pi * 4);
  EXPECT_NEAR(ricker(wave, zero), 0, 1e-12);
  // Two peaks of 2 exp(-1.5) beside it.
  EXPECT_NEAR(ricker(wave, 0.25 + std::sqrt(1.5) / (std::numbers::pi * 4)), 2 * std::exp(-1.5), 1e-12);
}

TEST(ground_motion, displacement_velocity_and_acceleration_belong_together) {
  for (const auto quantity : {MotionQuantity::displacement, MotionQuantity::velocity, MotionQuantity::acceleration}) {
    GroundMotion motion;
    motion.quantity = quantity;
    motion.ricker_wave = {2, 0.6};
    motion.sine_wave = {2, 3};
    for (const Real time : {0.3, 0.55, 0.61, 0.9, 1.2}) {
      motion.shape = GroundMotion::Shape::ricker;
      expect_consistent(motion, time, 200);
      motion.shape = GroundMotion::Shape::sine;
      expect_consistent(motion, time, 200);
    }
  }
  GroundMotion record;
  record.shape = GroundMotion::Shape::record;
  record.record = Record::make(0.1, {0, 1, -2, 0.5, 0});
  for (const Real time : {0.05, 0.17, 0.33, 0.36, 0.7}) expect_consistent(record, time, 10);
}

GroundMotion recorded(MotionQuantity quantity, Real step, std::vector<Real> values) {
  GroundMotion motion;
  motion.shape = GroundMotion::Shape::record;
  motion.quantity = quantity;
  motion.record = Record::make(step, std::move(values));
  return motion;
}

TEST(ground_motion, displacements_hold_after_their_end) {
  const GroundMotion lowered = recorded(MotionQuantity::displacement, 0.25, {0, -0.05, -0.1});
  EXPECT_NEAR(lowered.at(0.25).velocity, -0.2, 1e-15);
  for (const Real time : {0.5, 0.5 + 1e-9, 1.0, 1e6}) EXPECT_DOUBLE_EQ(lowered.at(time).displacement, -0.1) << time;
  EXPECT_EQ(lowered.at(1).velocity, 0);
  EXPECT_EQ(lowered.at(1).acceleration, 0);
  GroundMotion quarter;
  quarter.shape = GroundMotion::Shape::sine;
  quarter.quantity = MotionQuantity::displacement;
  quarter.amplitude = 0.3;
  quarter.sine_wave = {2, 0.25};
  EXPECT_NEAR(quarter.at(0.124).displacement, 0.3 * std::sin(4 * std::numbers::pi * 0.124), 1e-15);
  EXPECT_NEAR(quarter.at(5).displacement, 0.3, 1e-15);
  EXPECT_EQ(quarter.at(5).velocity, 0);
}

TEST(ground_motion, displacements_count_from_the_beginning) {
  const GroundMotion off = recorded(MotionQuantity::displacement, 0.5, {0.03, 0.04, 0.01});
  EXPECT_EQ(off.at(-1).displacement, 0);
  EXPECT_EQ(off.at(0).displacement, 0);
  EXPECT_NEAR(off.at(1e-9).displacement, 0, 1e-10);
  EXPECT_NEAR(off.at(0.5).displacement, 0.01, 1e-15);
  EXPECT_NEAR(off.at(9).displacement, -0.02, 1e-15);
  for (const auto quantity : {MotionQuantity::displacement, MotionQuantity::velocity, MotionQuantity::acceleration}) {
    GroundMotion wavelet;
    wavelet.quantity = quantity;
    wavelet.ricker_wave = {2, 0.5};
    EXPECT_EQ(wavelet.at(0).displacement, 0);
  }
}

/// One motion that ends away from where it began, given in three ways: x(t) = t - sin t to t = 2 pi, at rest at both ends.
TEST(ground_motion, the_three_ways_to_give_a_motion_agree) {
  constexpr int count = 2000;
  constexpr Real step = 2 * std::numbers::pi / count;
  std::vector<Real> x, v, a;
  for (int i = 0; i <= count; ++i) {
    x.push_back(7 + i * step - std::sin(i * step));
    v.push_back(1 - std::cos(i * step));
    a.push_back(std::sin(i * step));
  }
  const GroundMotion by_x = recorded(MotionQuantity::displacement, step, x), by_v = recorded(MotionQuantity::velocity, step, v),
                     by_a = recorded(MotionQuantity::acceleration, step, a);
  for (const Real time : {0.1, 1.0, 3.0, 6.2, 6.2832, 7.0, 20.0}) {
    const Real exact = std::min(time, 2 * std::numbers::pi) - (time < 2 * std::numbers::pi ? std::sin(time) : 0);
    for (const GroundMotion* motion : {&by_x, &by_v, &by_a}) EXPECT_NEAR(motion->at(time).displacement, exact, 2e-5) << time;
    EXPECT_NEAR(by_x.at(time).velocity, by_v.at(time).velocity, 2 * step) << time;
    EXPECT_NEAR(by_v.at(time).acceleration, by_a.at(time).acceleration, 2 * step) << time;
  }
}

TEST(ground_motion, record_is_integrated_exactly) {
  // Acceleration t: velocity t^2/2, displacement t^3/6.
  GroundMotion motion;
  motion.shape = GroundMotion::Shape::record;
  motion.record = Record::make(0.25, {0, 0.25, 0.5, 0.75, 1});
  EXPECT_DOUBLE_EQ(motion.at(0.6).velocity, 0.18);
  EXPECT_DOUBLE_EQ(motion.at(1).displacement, 1.0 / 6);
  // It goes on with the velocity it has.
  EXPECT_DOUBLE_EQ(motion.at(3).velocity, 0.5);
  EXPECT_DOUBLE_EQ(motion.at(3).displacement, 1.0 / 6 + 1);
  EXPECT_EQ(motion.at(-1).displacement, 0);
}

TEST(ground_motion, a_function_is_the_record_of_its_samples) {
  GroundMotion record, function;
  record.shape = GroundMotion::Shape::record;
  record.record = Record::make(0.1, {0, 1, -2, 0.5, 0.25});
  const auto samples = std::make_shared<Record>();
  samples->step = 0.1;
  function.shape = GroundMotion::Shape::function;
  function.samples = samples;
  EXPECT_EQ(function.at(0.05).velocity, 0);  // nothing is known yet
  for (const Real value : record.record.value) samples->add(value);
  for (const auto quantity : {MotionQuantity::displacement, MotionQuantity::velocity, MotionQuantity::acceleration})
    for (const Real time : {0.05, 0.1, 0.17, 0.33, 0.4, 0.7}) {
      function.quantity = record.quantity = quantity;
      EXPECT_EQ(function.at(time).displacement, record.at(time).displacement);
      EXPECT_EQ(function.at(time).velocity, record.at(time).velocity);
      EXPECT_EQ(function.at(time).acceleration, record.at(time).acceleration);
    }
}

TEST(ground_motion, baseline_takes_off_a_constant_and_a_line) {
  std::vector<Real> pure, shifted, tilted;
  for (int i = 0; i <= 1000; ++i) {
    const Real value = std::cos(2 * std::numbers::pi * i / 50.0);
    pure.push_back(value);
    shifted.push_back(value + 0.3);
    tilted.push_back(value + 0.3 - 0.001 * i);
  }
  Record plain = Record::make(0.01, pure), constant = Record::make(0.01, shifted), line = Record::make(0.01, tilted);
  EXPECT_GT(std::abs(constant.first.back()), 2.9);
  // What was added goes whole; what the pure record has of it goes with it.
  Record level = plain, straight = plain;
  for (const auto& [record, expected, degree] : {std::tuple{&constant, &level, 0}, {&line, &straight, 1}}) {
    take_off_baseline(*record, degree);
    take_off_baseline(*expected, degree);
    for (std::size_t i = 0; i < pure.size(); i += 50) {
      EXPECT_NEAR(record->first[i], expected->first[i], 1e-11);
      EXPECT_NEAR(record->first[i], 0, 0.1);
    }
  }
}

}  // namespace
}  // namespace sazare::laws
