#include "sazare/geometry/surface_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/core/plain_text.hpp"
#include "sazare/geometry/gmsh/file.hpp"

namespace sazare::geometry {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 5;
constexpr Real least_height = 1e-9;  // of the longest edge; below it a triangle is a line

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw UserError(fmt::format("{}: the surface cannot be read", file.string()));
  return text.str();
}

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

/// A binary STL has 80 bytes of anything, which may be "solid", the number of triangles, and 50 bytes for each: no text.
bool is_binary_stl(const std::string& bytes) { return bytes.find('\0') != std::string::npos; }

std::vector<Triangle> binary_stl(const fs::path& file, const std::string& bytes) {
  if (bytes.size() < header_bytes)
    throw UserError(fmt::format("{}: the file is cut short: a binary STL begins with {} bytes before its triangles, found {}",
                                file.string(), header_bytes, bytes.size()));
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
  const std::size_t expected = header_bytes + triangle_bytes * count;
  if (bytes.size() < expected)
    throw UserError(
        fmt::format("{}: the file is cut short: its header states {} triangles, {} bytes, but it ends after {} of them, {} bytes",
                    file.string(), count, expected, (bytes.size() - header_bytes) / triangle_bytes, bytes.size()));
  if (bytes.size() > expected)
    throw UserError(
        fmt::format("{}: a binary STL of {} triangles, as its header states, has {} bytes, found {}: is it an STL file?",
                    file.string(), count, expected, bytes.size()));
  std::vector<Triangle> triangles;
  for (std::size_t at = header_bytes; at < expected; at += triangle_bytes) {
    float numbers[12];  // the normal, which follows from the corners, and these
    std::memcpy(numbers, bytes.data() + at, sizeof numbers);
    Triangle& triangle = triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        triangle[static_cast<std::size_t>(corner)][axis] = static_cast<Real>(numbers[3 + 3 * corner + axis]);
  }
  return triangles;
}

[[noreturn]] void refuse_loop(const fs::path& file, std::size_t line, std::size_t corners) {
  throw UserError(fmt::format("{}:{}: a facet has {} corners, but those of an STL file have three: export triangles",
                              file.string(), line, corners < 3 ? fmt::format("{}", corners) : "four or more"));
}

std::vector<Triangle> text_stl(const fs::path& file, const std::string& text) {
  std::vector<Triangle> triangles;
  std::istringstream stream(plain_text(text));
  std::string line, word, rest;
  std::size_t corner = 0;  // of the facet, so far
  bool is_open = false;    // a solid has begun and not ended
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (word == "solid" || word == "endsolid") is_open = word == "solid";
    if (word == "endloop" && corner != 3) refuse_loop(file, number, corner);
    if (word == "endloop") corner = 0;
    if (word != "vertex") continue;
    if (corner == 3) refuse_loop(file, number, 4);
    if (corner == 0) triangles.emplace_back();
    Vector3& at = triangles.back()[corner++];
    if (!(words >> at.x() >> at.y() >> at.z()) || words >> rest)
      throw UserError(
          fmt::format("{}:{}: three numbers were expected after \"vertex\", found \"{}\"", file.string(), number, line));
  }
  if (corner != 0)
    throw UserError(fmt::format("{}: the file ends within its facet {}: it is cut short", file.string(), triangles.size()));
  if (is_open)
    throw UserError(
        fmt::format("{}: the file ends after {} facets without \"endsolid\": it is cut short; add that line if these are all",
                    file.string(), triangles.size()));
  return triangles;
}

/// Numbers of the physical surface group, or nothing where all count.
std::vector<std::int32_t> numbers_of_group(const GmshFile& mesh, const fs::path& file, const std::string& group) {
  std::vector<std::int32_t> numbers;
  std::vector<std::string> names;
  for (const std::int32_t number : group_numbers(mesh, 2)) {
    names.push_back(group_name(mesh, 2, number));
    if (names.back() == group) numbers.push_back(number);
  }
  if (!group.empty() && numbers.empty())
    throw UserError(
        fmt::format("{}: the mesh has no surface group \"{}\"; its groups: {}", file.string(), group, fmt::join(names, ", ")));
  return numbers;
}

std::vector<Triangle> gmsh_surface(const fs::path& file, const std::string& group) {
  const GmshFile mesh = read_gmsh_file(file);
  const std::vector<std::int32_t> wanted = numbers_of_group(mesh, file, group);
  std::map<std::int64_t, std::size_t> node_at;
  for (std::size_t i = 0; i < mesh.node_tags.size(); ++i) node_at[mesh.node_tags[i]] = i;
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < mesh.triangles.nodes.size(); ++i) {
    const auto groups = mesh.physical_groups.find({2, mesh.triangles.entities[i]});
    const bool counts =
        group.empty() || (groups != mesh.physical_groups.end() && std::ranges::any_of(groups->second, [&](std::int32_t number) {
                            return std::ranges::find(wanted, number) != wanted.end();
                          }));
    if (!counts) continue;
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto node = node_at.find(mesh.triangles.nodes[i][corner]);
      if (node == node_at.end())
        throw UserError(fmt::format("{}: triangle {} names node {}, which the file does not have", file.string(),
                                    mesh.triangles.tags[i], mesh.triangles.nodes[i][corner]));
      triangle[corner] = mesh.nodes[node->second];
    }
  }
  return triangles;
}

bool is_flat(const Triangle& corners) {
  const Real longest =
      std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(), (corners[0] - corners[2]).norm()});
  return !(2 * area_vector(corners).norm() > least_height * longest * longest);
}

void check_areas(const fs::path& file, const std::vector<Triangle>& triangles) {
  std::vector<std::size_t> flat;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (is_flat(triangles[i])) flat.push_back(i + 1);
  if (flat.empty()) return;
  const std::size_t shown = std::min(flat.size(), most_listed);
  throw UserError(fmt::format("{}: {} of {} triangles have no area, counted from 1: {}{}; remove them or mesh the surface again",
                              file.string(), flat.size(), triangles.size(),
                              fmt::join(flat.begin(), flat.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                              flat.size() > shown ? " ..." : ""));
}

}  // namespace

std::vector<Triangle> read_surface(const fs::path& file, const std::string& group, Real scale) {
  std::vector<Triangle> triangles;
  if (file.extension() == ".msh") {
    triangles = gmsh_surface(file, group);
  } else {
    const std::string bytes = read_bytes(file);
    triangles = is_binary_stl(bytes) ? binary_stl(file, bytes) : text_stl(file, bytes);
  }
  if (triangles.empty()) throw UserError(fmt::format("{}: the surface has no triangles", file.string()));
  for (Triangle& triangle : triangles)
    for (Vector3& corner : triangle) {
      corner *= scale;
      if (!corner.allFinite()) throw UserError(fmt::format("{}: a corner of the surface is not a finite number", file.string()));
    }
  check_areas(file, triangles);
  return triangles;
}

}  // namespace sazare::geometry
