#include <gtest/gtest.h>

#include <cstring>

#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

std::vector<Wall> box_walls() {
  Wall floor, side;
  side.normal = Vector3::UnitX();
  Wall slope;
  slope.triangles = {{Vector3(-1, -1, 0.0), Vector3(1, -1, 0.0), Vector3(0, 1, 0.01)}};
  return {floor, side, slope};
}

Rules rules(laws::ContactModel model) {
  return {.restitution = 0.6,
          .friction = 0.4,
          .rolling = 0.05,
          .twisting = 0.02,
          .step = 1e-5,
          .gravity = {0, 0, -9.81},
          .model = model};
}

test::MemoryArchive state_of(methods::spheres::SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

class OfModel : public testing::TestWithParam<laws::ContactModel> {};

TEST_P(OfModel, spheres_give_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = make_stepper(heap(21, 0.5, 0.0195), rules(GetParam()), box_walls());  // 9261 spheres: ten tiles
    stepper.start();
    advance(stepper, 150);
    EXPECT_GT(stepper.searches(), 2);
    EXPECT_GT(stepper.contacts(), 300);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  const auto alone = run(1);
  for (const int threads : {2, 3, 7}) EXPECT_TRUE(run(threads) == alone) << threads;
}

TEST_P(OfModel, spheres_go_on_from_a_checkpoint_as_if_nothing_had_been) {
  auto through = make_stepper(heap(8, 0.5, 0.0195), rules(GetParam()), box_walls()),
       resumed = make_stepper(heap(8, 0.5, 0.0195), rules(GetParam()), box_walls());
  through.start();
  advance(through, 777);
  test::MemoryArchive checkpoint = state_of(through);
  checkpoint.turn_round();
  resumed.columns(checkpoint);
  advance(through, 500);
  advance(resumed, 500);
  EXPECT_GT(through.contacts(), 30);
  EXPECT_TRUE(state_of(through) == state_of(resumed));
}

INSTANTIATE_TEST_SUITE_P(same_bits, OfModel, testing::Values(laws::ContactModel::hertz, laws::ContactModel::mindlin_deresiewicz));

}  // namespace
}  // namespace sazare::methods::spheres
