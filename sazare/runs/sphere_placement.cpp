#include "sazare/runs/sphere_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sazare/cases/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/random.hpp"
#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::runs {

namespace {

using cases::short_number;
using cases::SphereGroup;
using cases::SphereSource;

constexpr int most_tries = 2000;  // for a place of a random sphere
constexpr std::size_t most_listed = 4;

struct Ball {
  Vector3 centre;
  Real radius = 0;
};

std::vector<Ball> read_balls(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw UserError(fmt::format("{}: the file of spheres cannot be read", file.string()));
  std::vector<Ball> balls;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::ranges::replace(line, ',', ' ');
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#' || std::isalpha(static_cast<unsigned char>(line[begin])) != 0) continue;
    std::istringstream words(line);
    Ball ball;
    std::string rest;
    if (!(words >> ball.radius >> ball.centre.x() >> ball.centre.y() >> ball.centre.z()) || words >> rest)
      throw UserError(
          fmt::format("{}:{}: four numbers were expected, radius, x, y and z in m, found \"{}\"", file.string(), number, line));
    if (!(ball.radius > 0) || !ball.centre.allFinite())
      throw UserError(fmt::format("{}:{}: a radius greater than 0 and a finite centre were expected, found \"{}\"", file.string(),
                                  number, line));
    balls.push_back(ball);
  }
  return balls;
}

std::vector<Ball> lattice(const SphereGroup& group) {
  const Real spacing = group.spacing.value_or(2 * group.radius);
  std::array<std::int64_t, 3> count;
  Vector3 first;
  for (int axis = 0; axis < 3; ++axis) {
    const Real room = group.upper[axis] - group.lower[axis] - 2 * group.radius;
    const auto a = static_cast<std::size_t>(axis);
    count[a] = room < -1e-9 * spacing ? 0 : static_cast<std::int64_t>(std::floor(room / spacing + 1e-9)) + 1;
    first[axis] = 0.5 * (group.lower[axis] + group.upper[axis] - spacing * static_cast<Real>(count[a] - 1));
  }
  std::vector<Ball> balls;
  for (std::int64_t k = 0; k < count[2]; ++k)
    for (std::int64_t j = 0; j < count[1]; ++j)
      for (std::int64_t i = 0; i < count[0]; ++i)
        balls.push_back(
            {first + spacing * Vector3(static_cast<Real>(i), static_cast<Real>(j), static_cast<Real>(k)), group.radius});
  return balls;
}

class Placer {
public:
  explicit Placer(const cases::CaseFile& file) : file_(file), spheres_(file.spheres()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!spheres_.domain.periodic[static_cast<std::size_t>(axis)]) continue;
      result_.spheres.box.lower[axis] = spheres_.domain.lower[axis];
      result_.spheres.box.length[axis] = spheres_.domain.upper[axis] - spheres_.domain.lower[axis];
    }
  }

  Placement place() {
    for (std::size_t i = 0; i < spheres_.spheres.size(); ++i) add(i);
    check_sizes();
    check_overlaps();
    return std::move(result_);
  }

private:
  void add(std::size_t number) {
    const SphereGroup& group = spheres_.spheres[number];
    std::vector<Ball> balls;
    if (group.source == SphereSource::one) balls = {{group.centre, group.radius}};
    if (group.source == SphereSource::file) balls = read_balls(group.file);
    if (group.source == SphereSource::lattice) balls = lattice(group);
    if (group.source == SphereSource::random) balls = scatter(number);
    if (balls.empty())
      refuse(file_, fmt::format("spheres.{}", number), fmt::format("the group \"{}\" has no sphere", group.name),
             group.source == SphereSource::file ? "the file holds no row of radius, x, y and z"
                                                : "its box is too small for the radius");
    const auto material = std::ranges::find(spheres_.materials, group.material, &cases::SphereMaterial::name);
    Random random(group.seed);
    for (const Ball& ball : balls) {
      result_.spheres.add(ball.centre, ball.radius, material->density, static_cast<Index>(material - spheres_.materials.begin()),
                          group.held);
      result_.group.push_back(static_cast<Index>(number));
      Vector3 velocity = group.velocity;
      if (group.noise > 0)
        for (Real& part : velocity) part += random.between(-group.noise, group.noise);
      if (!group.held) result_.spheres.set_motion(result_.spheres.size() - 1, velocity, group.spin);
    }
  }

  /// Random places without overlap, one after the other, the largest first.
  std::vector<Ball> scatter(std::size_t number) {
    const SphereGroup& group = spheres_.spheres[number];
    Random random(group.seed);
    std::vector<Ball> balls(static_cast<std::size_t>(group.count));
    for (Ball& ball : balls) ball.radius = random.between(group.radius, group.largest_radius.value_or(group.radius));
    std::ranges::stable_sort(balls, std::ranges::greater{}, &Ball::radius);
    neighbors::SphereGrid grid;
    std::vector<Ball> all;
    for (const auto& place : result_.spheres.place) all.push_back({result_.spheres.box.wrapped(place.centre()), place.radius});
    for (std::size_t i = 0; i < all.size(); ++i) grid.place(static_cast<Index>(i), all[i].centre, all[i].radius);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      int tries = 0;
      do {
        if (++tries > most_tries) refuse_full(number, i, balls);
        for (int axis = 0; axis < 3; ++axis) {
          const Real inset = repeats(axis, group) ? 0 : balls[i].radius;
          balls[i].centre[axis] = random.between(group.lower[axis] + inset, group.upper[axis] - inset);
        }
      } while (hits(grid, all, balls[i]));
      all.push_back({result_.spheres.box.wrapped(balls[i].centre), balls[i].radius});
      grid.place(static_cast<Index>(all.size() - 1), all.back().centre, balls[i].radius);
    }
    return balls;
  }

  /// Whether the group's box goes through the whole of a periodic axis.
  bool repeats(int axis, const SphereGroup& group) const {
    const Real length = result_.spheres.box.length[axis];
    return length > 0 && group.upper[axis] - group.lower[axis] >= length * (1 - 1e-9);
  }

  bool hits(const neighbors::SphereGrid& grid, const std::vector<Ball>& all, const Ball& ball) const {
    const Vector3 length = result_.spheres.box.length, centre = result_.spheres.box.wrapped(ball.centre);
    const auto most = [&](int axis) { return length[axis] > 0 ? 1 : 0; };
    bool hit = false;
    for (int x = -most(0); x <= most(0); ++x)
      for (int y = -most(1); y <= most(1); ++y)
        for (int z = -most(2); z <= most(2); ++z) {
          const Vector3 image = centre + Vector3(x * length.x(), y * length.y(), z * length.z());
          grid.visit_near(image, ball.radius, [&](Index i) {
            const Ball& other = all[static_cast<std::size_t>(i)];
            hit = hit || (other.centre - image).norm() < other.radius + ball.radius;
          });
        }
    return hit;
  }

  [[noreturn]] void refuse_full(std::size_t number, std::size_t placed, const std::vector<Ball>& balls) const {
    const SphereGroup& group = spheres_.spheres[number];
    Real volume = 0;
    for (std::size_t i = 0; i < placed; ++i) volume += 4.18879020478639098462 * std::pow(balls[i].radius, 3);
    const Real share = volume / (group.upper - group.lower).prod();
    refuse(file_, fmt::format("spheres.{}.count", number),
           fmt::format("no room for sphere {} of {} of the group \"{}\": those before fill {} of the box", placed + 1,
                       group.count, group.name, short_number(share, 3)),
           "random places without overlap rarely fill more than 0.35: choose a larger box or fewer spheres, and let them settle "
           "under gravity");
  }

  void check_sizes() const {
    Real largest = 0;
    for (const auto& place : result_.spheres.place) largest = std::max(largest, place.radius);
    const Real reach = 2 * largest + search_margin(spheres_, result_.spheres);
    for (int axis = 0; axis < 3; ++axis) {
      const Real length = result_.spheres.box.length[axis];
      if (length <= 0 || length >= 2 * reach) continue;
      refuse(file_, "domain.upper",
             fmt::format("the room is {} m along the periodic axis {}, and the largest sphere {} m wide", short_number(length),
                         "xyz"[axis], short_number(2 * largest)),
             fmt::format("a sphere must not meet another one, or itself, on both sides: {} m or more are needed",
                         short_number(2 * reach, 4)));
    }
  }

  void check_overlaps() const {
    struct Overlap {
      Real share;
      std::size_t first, second;
    };
    const state::Spheres& spheres = result_.spheres;
    const neighbors::SpherePairs pairs = neighbors::find_pairs(spheres, 0);
    const Vector3 length = spheres.box.length, inverse = spheres.box.inverse();
    std::vector<Overlap> found;
    for (std::size_t i = 0; i < spheres.size(); ++i)
      for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) {
        const auto j = static_cast<std::size_t>(pairs.other[p]);
        Vector3 apart = spheres.place[j].centre() - spheres.place[i].centre();
        for (int axis = 0; axis < 3; ++axis) apart[axis] -= length[axis] * std::nearbyint(apart[axis] * inverse[axis]);
        const Real overlap = spheres.place[i].radius + spheres.place[j].radius - apart.norm();
        const Real share = overlap / std::min(spheres.place[i].radius, spheres.place[j].radius);
        if (share > spheres_.contact.overlap_limit) found.push_back({share, i, j});
      }
    if (found.empty()) return;
    std::ranges::stable_sort(found, std::ranges::greater{}, &Overlap::share);
    std::string list;
    for (std::size_t n = 0; n < std::min(found.size(), most_listed); ++n)
      list += fmt::format("{}{} and {} by {}", n > 0 ? ", " : "", name_of(found[n].first), name_of(found[n].second),
                          short_number(found[n].share, 3));
    refuse(file_, "contact.overlap_limit",
           fmt::format("{} pairs of spheres overlap at the start by more than {} of the smaller radius: {}{}", found.size(),
                       short_number(spheres_.contact.overlap_limit), list, found.size() > most_listed ? " ..." : ""),
           "move them apart, or raise overlap_limit where they are meant to be pressed together");
  }

  /// "bed 12 at (0, 0, 1)": counted from 1 within the group.
  std::string name_of(std::size_t sphere) const {
    const Index group = result_.group[sphere];
    const auto first = std::ranges::find(result_.group, group) - result_.group.begin();
    const auto& at = result_.spheres.place[sphere];
    return fmt::format("{} {} at ({}, {}, {})", spheres_.spheres[static_cast<std::size_t>(group)].name,
                       static_cast<std::ptrdiff_t>(sphere) - first + 1, short_number(at.x, 4), short_number(at.y, 4),
                       short_number(at.z, 4));
  }

  const cases::CaseFile& file_;
  const cases::SpheresCase& spheres_;
  Placement result_;
};

}  // namespace

Real search_margin(const cases::SpheresCase& spheres, const state::Spheres& placed) {
  const auto smallest = std::ranges::min_element(placed.place, {}, &state::SpherePlace::radius);
  return smallest == placed.place.end() ? 0 : spheres.contact.margin * 2 * smallest->radius;
}

Placement place_spheres(const cases::CaseFile& file) { return Placer(file).place(); }

}  // namespace sazare::runs
