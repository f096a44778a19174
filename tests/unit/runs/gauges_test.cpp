#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/gauges.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

TEST(Gauges, FindTheElementThatHoldsAPoint) {
  const BlocksModel model = test::block_model(test::block_case());
  for (Index element = 0; element < model.simulation->bodies().size(); ++element)
    EXPECT_EQ(element_at(model.mesh, geometry::centroid(geometry::corners_of(model.mesh, element))), element);
}

TEST(Gauges, APointOnACornerBelongsToOneOfItsElements) {
  const BlocksModel model = test::block_model(test::block_case());
  EXPECT_GE(element_at(model.mesh, Vector3(0, 0, 0)), 0);
  EXPECT_EQ(element_at(model.mesh, Vector3(-1e-6, 0, 0)), -1);
}

TEST(Gauges, GiveTheVelocityOfTheirMaterialPoint) {
  const cases::CaseFile file = test::block_case();
  BlocksModel model = test::block_model(file);
  Gauges gauges(file, model.mesh);
  // The body turns as a whole about the z axis through the origin, after a quarter turn and a shift.
  const Vector3 spin(0, 0, 7), shift(1, 2, 3);
  const Matrix3 quarter = Eigen::AngleAxis<Real>(EIGEN_PI / 2, Vector3::UnitZ()).toRotationMatrix();
  const auto& bodies = model.simulation->bodies();
  levels::Snapshot<3> now = model.simulation->snapshot();
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    now.velocity[i] = spin.cross(quarter * now.pose[i].position);
    now.pose[i] = {quarter * now.pose[i].position + shift, quarter * now.pose[i].rotation};
    const Matrix3 inertia =
        now.pose[i].rotation * bodies.inertia[i].inverse_moments.cwiseInverse().asDiagonal() * now.pose[i].rotation.transpose();
    now.angular_momentum[i] = inertia * spin;
  }
  const std::vector<Real> row = gauges.sample(1e-3, bodies, now);
  ASSERT_EQ(row.size(), 7u);
  EXPECT_EQ(row[0], 1e-3);
  const Vector3 expected = spin.cross(quarter * Vector3(0.2, 0.15, 0.2));
  EXPECT_LT((Vector3(row[1], row[2], row[3]) - expected).norm(), 1e-12);
  EXPECT_NEAR(gauges.peaks()[0].second, expected.norm(), 1e-12);
}

TEST(Gauges, AreWatchedWithTheVelocityOfARow) {
  const cases::CaseFile file = test::block_case();
  BlocksModel model = test::block_model(file);
  Gauges by_row(file, model.mesh), watched(file, model.mesh);
  model.simulation->start();
  for (int step = 0; step < 40; ++step) model.simulation->advance();
  by_row.sample(1e-3, model.simulation->bodies(), model.simulation->snapshot());
  watched.watch(1e-3, *model.simulation);
  EXPECT_GT(watched.peaks()[0].second, 0);
  EXPECT_EQ(watched.peaks(), by_row.peaks());
}

TEST(GaugePeak, HasTheLargestSpeedAndTheLargestOfEachComponent) {
  GaugePeak peak;
  peak.raise(1, Vector3(3, -4, 0));
  peak.raise(2, Vector3(-3.5, 0, 1));
  EXPECT_EQ(peak.speed, 5);
  EXPECT_EQ(peak.time, 1);
  EXPECT_EQ(peak.components, (std::array<Real, 3>{3.5, 4, 1}));
}

TEST(GaugePeak, OfTwoProcessesIsThatOfBoth) {
  GaugePeak first, second, both;
  first.raise(1, Vector3(3, -4, 0));
  second.raise(2, Vector3(-5, 1, 1));
  both.raise(1, Vector3(3, -4, 0));
  both.raise(2, Vector3(-5, 1, 1));
  GaugePeak united = second;
  united.raise(first);
  first.raise(second);
  for (const GaugePeak& one : {united, first}) {
    EXPECT_EQ(one.speed, both.speed);
    EXPECT_EQ(one.time, both.time);
    EXPECT_EQ(one.components, both.components);
  }
}

TEST(Gauges, OutsideTheBodyAreRefusedWithTheNearestElement) {
  const cases::CaseFile file = test::block_case({"gauges.1.point=[5, 0, 0]"});
  const BlocksModel model = test::block_model(file);
  const std::string words = test::words_of<UserError>([&] { Gauges(file, model.mesh); });
  EXPECT_NE(words.find("gauge \"G2\" at (5, 0, 0) m is in no element"), std::string::npos) << words;
  EXPECT_NE(words.find("the nearest element is"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
