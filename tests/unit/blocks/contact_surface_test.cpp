#include "sazare/methods/blocks/contact_surface.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/support/memory_archive.hpp"

namespace sazare::methods::blocks {
namespace {

constexpr Index body_count = 30;
constexpr Real skin = 0.05;
constexpr int division = 5;

/// Blocks of several sizes at random, some faces open; spheres are numbered as the faces were opened.
class Crowd {
public:
  explicit Crowd(unsigned seed) : random_(seed), surface_(body_count, division, skin) {
    for (Index body = 0; body < body_count; ++body) {
      poses_.push_back(random_pose());
      const Real size = number(0.2, 0.8);
      const geometry::Tetrahedron own = {size * Vector3(1, 1, 1), size * Vector3(-1, 1, -1), size * Vector3(1, -1, -1),
                                         size * Vector3(-1, -1, 1)};
      geometry::Tetrahedron corners;
      for (std::size_t i = 0; i < 4; ++i) corners[i] = poses_.back().position + poses_.back().rotation * own[i];
      for (int face = 0; face < 4; ++face) {
        if (number(0, 1) < 0.3) continue;
        surface_.open({body, face}, corners, poses_.back());
        for (std::size_t i = 0; i < contact_spheres(own, face, division).size(); ++i) body_of_.push_back(body);
      }
    }
    place_all();
  }

  void shuffle() {
    for (auto& pose : poses_) pose = random_pose();
    place_all();
  }

  ContactSurface& surface() { return surface_; }
  std::function<state::Pose<3>(Index)> pose_of() const {
    return [this](Index body) { return poses_[static_cast<std::size_t>(body)]; };
  }

  /// Moves all bodies a little; the surface does not know.
  void drift(Real by) {
    for (auto& pose : poses_) pose.position += Vector3(number(-by, by), number(-by, by), number(-by, by));
  }

  /// Pairs of spheres nearer than the skin, by partner.
  std::map<Index, std::vector<SpherePair>> by_brute_force(Index body) const {
    std::map<Index, std::vector<SpherePair>> found;
    const auto spheres = static_cast<Index>(body_of_.size());
    for (Index i = 0; i < spheres; ++i)
      for (Index j = 0; j < spheres; ++j) {
        if (of(i) != body || of(j) == body) continue;
        const Real overlap = surface_.sphere(i).radius + surface_.sphere(j).radius - (centre(i) - centre(j)).norm();
        if (overlap < -skin) continue;
        const bool in_order = body < of(j);
        found[of(j)].push_back({in_order ? i : j, in_order ? j : i, std::max(overlap, Real{0}), 0, {}});
      }
    for (auto& [partner, pairs] : found)
      std::ranges::sort(pairs, {}, [](const SpherePair& pair) { return std::pair(pair.first, pair.second); });
    return found;
  }

private:
  Real number(Real from, Real to) { return std::uniform_real_distribution<Real>(from, to)(random_); }
  state::Pose<3> random_pose() {
    const Quaternion turn = Quaternion(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
    return {{number(-2, 2), number(-2, 2), number(-2, 2)}, turn.toRotationMatrix()};
  }
  void place_all() {
    for (const Index body : surface_.bodies()) surface_.place(body, poses_[static_cast<std::size_t>(body)]);
  }
  Index of(Index sphere) const { return body_of_[static_cast<std::size_t>(sphere)]; }
  Vector3 centre(Index sphere) const {
    const auto& pose = poses_[static_cast<std::size_t>(of(sphere))];
    return pose.position + pose.rotation * surface_.sphere(sphere).centre;
  }

  std::mt19937_64 random_;
  ContactSurface surface_;
  std::vector<state::Pose<3>> poses_;
  std::vector<Index> body_of_;  ///< by sphere
};

int expect_as_brute_force(const Crowd& crowd, const ContactSurface& surface, Index body) {
  const auto expected = crowd.by_brute_force(body);
  const auto found = surface.search(
      body, [](Index) { return false; }, crowd.pose_of());
  EXPECT_EQ(found.size(), expected.size());
  auto next = expected.begin();
  int pairs = 0;
  for (const NearPair& near : found) {
    if (next == expected.end()) break;
    EXPECT_EQ(near.first, std::min(body, next->first));
    EXPECT_EQ(near.second, std::max(body, next->first));
    EXPECT_EQ(near.spheres.size(), next->second.size());
    for (std::size_t i = 0; i < std::min(near.spheres.size(), next->second.size()); ++i) {
      EXPECT_EQ(near.spheres[i].first, next->second[i].first);
      EXPECT_EQ(near.spheres[i].second, next->second[i].second);
      EXPECT_NEAR(near.spheres[i].initial_overlap, next->second[i].initial_overlap, 1e-14);
      ++pairs;
    }
    ++next;
  }
  return pairs;
}

TEST(contact_surface, finds_the_near_spheres_that_brute_force_finds) {
  int pairs = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Crowd crowd(seed);
    for (int round = 0; round < 3; ++round) {
      for (const Index body : crowd.surface().bodies()) pairs += expect_as_brute_force(crowd, crowd.surface(), body);
      crowd.shuffle();
    }
  }
  EXPECT_GT(pairs, 1000);
}

TEST(contact_surface, overlaps_are_those_of_the_present_places) {
  Crowd crowd(6);
  crowd.drift(0.1 * skin);  // as between two searches
  int overlapping = 0;
  for (const Index body : crowd.surface().bodies()) {
    const auto expected = crowd.by_brute_force(body);
    for (const NearPair& near : crowd.surface().search(
             body, [](Index) { return false; }, crowd.pose_of()))
      for (const SpherePair& pair : near.spheres)
        for (const SpherePair& same : expected.at(near.first == body ? near.second : near.first))
          if (same.first == pair.first && same.second == pair.second) {
            EXPECT_NEAR(pair.initial_overlap, same.initial_overlap, 1e-14);
            overlapping += pair.initial_overlap > 0;
          }
  }
  EXPECT_GT(overlapping, 10);
}

TEST(contact_surface, leaves_out_partners_that_are_skipped) {
  Crowd crowd(3);
  for (const Index body : crowd.surface().bodies())
    for (const auto& near : crowd.surface().search(
             body, [](Index partner) { return partner % 2 == 0; }, crowd.pose_of()))
      EXPECT_EQ((near.first == body ? near.second : near.first) % 2, 1);
}

TEST(contact_surface, finds_the_same_after_a_checkpoint) {
  Crowd crowd(4);
  test::MemoryArchive checkpoint;
  crowd.surface().columns(checkpoint);
  checkpoint.turn_round();
  ContactSurface copy(body_count, division, skin);
  copy.columns(checkpoint);
  int pairs = 0;
  for (const Index body : copy.bodies()) pairs += expect_as_brute_force(crowd, copy, body);
  EXPECT_GT(pairs, 50);
}

TEST(contact_surface, how_far_a_body_moved_bounds_how_far_any_of_its_points_did) {
  ContactSurface surface(1, division, skin);
  const geometry::Tetrahedron corners = {Vector3(1, 1, 1), Vector3(-1, 1, -1), Vector3(1, -1, -1), Vector3(-1, -1, 1)};
  surface.open({0, 0}, corners, {Vector3::Zero(), Matrix3::Identity()});
  const state::Pose<3> moved{{0.1, 0.2, -0.1}, Eigen::AngleAxis<Real>(0.3, Vector3(1, 2, 3).normalized()).toRotationMatrix()};
  Real farthest = 0;
  for (const Vector3& corner : corners) farthest = std::max(farthest, (moved.position + moved.rotation * corner - corner).norm());
  EXPECT_GE(surface.moved(0, moved, std::sqrt(3.0)), farthest);
  EXPECT_EQ(surface.moved(0, state::Pose<3>{Vector3::Zero(), Matrix3::Identity()}, std::sqrt(3.0)), 0);
}

}  // namespace
}  // namespace sazare::methods::blocks
