#include "sazare/methods/spheres/run/placing/bodies_file.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

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

}  // namespace

std::vector<FileBody> read_bodies(const std::filesystem::path& bodies, const std::filesystem::path& spheres) {
  std::vector<FileBody> made;
  std::vector<std::size_t> lines;
  std::map<Real, std::size_t> by_number;
  for (const auto& [line, row] : read_rows(bodies, body_rows)) {
    if (!by_number.emplace(row[0], made.size()).second) refuse_row(bodies, line, fmt::format("the body {} stands twice", row[0]));
    made.push_back(body_of(bodies, line, row));
    lines.push_back(line);
  }
  for (const auto& [line, row] : read_rows(spheres, member_rows)) {
    const auto found = by_number.find(row[0]);
    if (found == by_number.end())
      refuse_row(spheres, line, fmt::format("a sphere of the body {}, which is not in {}", row[0], bodies.filename().string()));
    const geometry::Ball ball{{row[2], row[3], row[4]}, row[1]};
    if (!(ball.radius > 0) || !std::isfinite(ball.radius) || !ball.centre.allFinite())
      refuse_row(spheres, line, "a radius greater than 0 and a finite centre were expected");
    made[found->second].balls.push_back(ball);
  }
  for (std::size_t i = 0; i < made.size(); ++i)
    if (made[i].balls.empty())
      refuse_row(bodies, lines[i], fmt::format("this body has no sphere in {}", spheres.filename().string()));
  return made;
}

}  // namespace sazare::runs
