#include "sazare/methods/spheres/run/placing/bodies_file.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/spheres/run/placing/file.hpp"

namespace sazare::runs {

namespace {

const RowFormat body_rows{{{"body"},
                           {"volume"},
                           {"x"},
                           {"y"},
                           {"z"},
                           {"vx"},
                           {"vy"},
                           {"vz"},
                           {"wx"},
                           {"wy"},
                           {"wz"},
                           {"ixx"},
                           {"iyy"},
                           {"izz"},
                           {"ixy"},
                           {"iyz"},
                           {"izx"}},
                          "seventeen numbers were expected: of a body its number, volume, centre, velocity, angular velocity and "
                          "inertia over density"};

const RowFormat member_rows{{{"body"}, {"radius", "r"}, {"x"}, {"y"}, {"z"}},
                            "five numbers were expected, the number of a body, radius, x, y and z in m"};

[[noreturn]] void refuse_row(const std::filesystem::path& file, std::size_t line, const std::string& what) {
  throw UserError(fmt::format("{}:{}: {}", file.string(), line, what));
}

void check_number(const std::filesystem::path& file, std::size_t line, Real number) {
  if (number != std::floor(number) || std::abs(number) > 1e15)
    refuse_row(file, line, fmt::format("the number of a body is a whole number, found {}", number));
}

/// Products of inertia have the sign of the matrix: ixy is minus the integral of x y.
Matrix3 inertia_of(const std::vector<Real>& row) {
  Matrix3 inertia;
  inertia << row[11], row[14], row[16], row[14], row[12], row[15], row[16], row[15], row[13];
  return inertia;
}

/// No principal moment of a body is larger than the other two together.
bool is_of_a_body(const Matrix3& inertia) {
  if (!inertia.allFinite()) return false;
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  return moments[0] > 0 && moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9);
}

FileBody body_of(const std::filesystem::path& file, std::size_t line, const std::vector<Real>& row) {
  FileBody body;
  body.volume = row[1];
  body.centre = {row[2], row[3], row[4]};
  body.velocity = {row[5], row[6], row[7]};
  body.spin = {row[8], row[9], row[10]};
  body.inertia = inertia_of(row);
  if (!(body.volume > 0) || !std::isfinite(body.volume)) refuse_row(file, line, "the volume of a body must be greater than 0");
  if (!body.centre.allFinite() || !body.velocity.allFinite() || !body.spin.allFinite())
    refuse_row(file, line, "centre, velocity and angular velocity of a body must be finite");
  if (!is_of_a_body(body.inertia))
    refuse_row(
        file, line,
        "no body has this inertia: its principal moments must be greater than 0, and none larger than the other two together");
  return body;
}

/// What a body says of itself must be possible. Spheres need not fill it, and may be few and small: its reach is that of its
/// spheres and a length by its volume.
void check_against_spheres(const std::filesystem::path& file, std::size_t line, const FileBody& body) {
  Eigen::AlignedBox<Real, 3> box;
  Real filled = 0;
  for (const geometry::Ball& ball : body.balls) {
    box.extend(ball.centre - Vector3::Constant(ball.radius));
    box.extend(ball.centre + Vector3::Constant(ball.radius));
    filled = std::max(filled, ball.radius * ball.radius * ball.radius);
  }
  constexpr Real least_share = 1e-3;  // of the largest sphere, which lies within the body
  if (body.volume < least_share * filled)
    refuse_row(file, line,
               fmt::format("this body has {} m3, and its largest sphere {} m3", cases::short_number(body.volume, 3),
                           cases::short_number(4.18879 * filled, 3)));
  const Real reach = box.sizes().norm() + 4 * std::cbrt(body.volume), away = (body.centre - box.center()).norm();
  if (away > reach)
    refuse_row(
        file, line,
        fmt::format("the centre of mass of this body is {} m away from the middle of its spheres, and by spheres and volume it "
                    "reaches {} m at most",
                    cases::short_number(away, 3), cases::short_number(reach, 3)));
  const Real gyration = std::sqrt(0.5 * body.inertia.trace() / body.volume);
  if (gyration > reach)
    refuse_row(
        file, line,
        fmt::format("the inertia of this body is that of a mass {} m from its centre, and by spheres and volume it reaches {} m "
                    "at most: an inertia over density in m5 was expected",
                    cases::short_number(gyration, 3), cases::short_number(reach, 3)));
}

}  // namespace

std::vector<FileBody> read_bodies(const std::filesystem::path& bodies, const std::filesystem::path& spheres) {
  std::vector<FileBody> made;
  std::vector<std::size_t> lines;
  std::map<Real, std::size_t> by_number;
  for (const auto& [line, row] : read_rows(bodies, body_rows)) {
    check_number(bodies, line, row[0]);
    if (!by_number.emplace(row[0], made.size()).second) refuse_row(bodies, line, fmt::format("the body {} stands twice", row[0]));
    made.push_back(body_of(bodies, line, row));
    lines.push_back(line);
  }
  if (made.empty()) throw UserError(fmt::format("{}: the file has no body", bodies.string()));
  for (const auto& [line, row] : read_rows(spheres, member_rows)) {
    check_number(spheres, line, row[0]);
    const auto found = by_number.find(row[0]);
    if (found == by_number.end())
      refuse_row(spheres, line, fmt::format("a sphere of the body {}, which is not in {}", row[0], bodies.filename().string()));
    const geometry::Ball ball{{row[2], row[3], row[4]}, row[1]};
    if (!(ball.radius > 0) || !std::isfinite(ball.radius) || !ball.centre.allFinite())
      refuse_row(spheres, line, "a radius greater than 0 and a finite centre were expected");
    made[found->second].balls.push_back(ball);
  }
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (made[i].balls.empty())
      refuse_row(bodies, lines[i], fmt::format("this body has no sphere in {}", spheres.filename().string()));
    check_against_spheres(bodies, lines[i], made[i]);
  }
  return made;
}

}  // namespace sazare::runs
