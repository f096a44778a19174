#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "msh_writer.hpp"
#include "sazare/core/error.hpp"
#include "sazare/geometry/gmsh/mesher.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {
namespace {

using test::TemporaryFolder;

constexpr const char* box = R"(
SetFactory("OpenCASCADE");
DefineConstant[ depth = 1 ];
Box(1) = {0, 0, 0, 1, 1, depth};
Physical Volume("rock") = {1};
Physical Surface("skin") = Boundary{ Volume{1}; };
Mesh.MeshSizeMax = 0.5;
)";

Real total_volume(const TetraMesh& mesh) {
  Real sum = 0;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) sum += volume(corners_of(mesh, static_cast<std::int32_t>(i)));
  return sum;
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

template <class Error>
std::string words_of(const MeshRequest& request) {
  try {
    mesh_geometry(request);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

#define EXPECT_WORDS(words, part) EXPECT_NE((words).find(part), std::string::npos) << "words: " << (words)

TEST(gmsh_mesher, meshes_a_geometry_with_its_parameters) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh"};
  mesh_geometry(request);
  const TetraMesh mesh = read_gmsh(request.mesh, 1);
  EXPECT_NEAR(total_volume(mesh), 1, 1e-12);
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"rock"});
  EXPECT_EQ(mesh.surfaces.at(0).name, "skin");
  request.parameters = {{"depth", 2.5}};
  mesh_geometry(request);
  EXPECT_NEAR(total_volume(read_gmsh(request.mesh, 1)), 2.5, 1e-12);
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(gmsh_mesher, same_request_gives_the_same_bytes) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "a.msh"};
  mesh_geometry(request);
  request.mesh = folder.path() / "b.msh";
  mesh_geometry(request);
  EXPECT_EQ(test::read_text(folder.path() / "a.msh"), test::read_text(folder.path() / "b.msh"));
}

TEST(gmsh_mesher, settings_of_the_user_do_not_change_the_mesh) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "a.msh"};
  mesh_geometry(request);
  folder.write(".gmshrc", "Mesh.MeshSizeFactor = 0.3;\n");
  ASSERT_EQ(setenv("GMSH_HOME", folder.path().c_str(), 1), 0);
  request.mesh = folder.path() / "b.msh";
  mesh_geometry(request);
  unsetenv("GMSH_HOME");
  EXPECT_EQ(test::read_text(folder.path() / "a.msh"), test::read_text(folder.path() / "b.msh"));
}

TEST(gmsh_mesher, size_factor_refines) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh"};
  mesh_geometry(request);
  const std::size_t coarse = read_gmsh(request.mesh, 1).tetrahedra.size();
  request.size_factor = 0.5;
  mesh_geometry(request);
  EXPECT_GT(read_gmsh(request.mesh, 1).tetrahedra.size(), 4 * coarse);
}

TEST(gmsh_mesher, names_with_spaces_and_quotes_are_plain_names) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("a box; touch 'x' $(id).geo", box), folder.path() / "my \"mesh\".msh"};
  mesh_geometry(request);
  EXPECT_NEAR(total_volume(read_gmsh(request.mesh, 1)), 1, 1e-12);
  EXPECT_EQ(files_in(folder.path()), 2u);
}

/// A program in the place of gmsh; "$4" is the file that it is to write.
std::string in_place_of_gmsh(const TemporaryFolder& folder, const std::string& does) {
  const std::filesystem::path program = folder.write("gmsh.sh", "#!/bin/sh\n" + does + "\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  return program.string();
}

TEST(gmsh_mesher, a_mesh_that_is_cut_short_is_not_kept) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "meshes/box.msh"};
  request.program =
      in_place_of_gmsh(folder, "printf '$MeshFormat\\n4.1 1 8\\n$EndMeshFormat\\n$Nodes\\n1 2 3 and much more of them' > \"$4\"");
  EXPECT_WORDS(words_of<MachineError>(request), "box.msh: the mesh written by gmsh is truncated: is the disk full?");
  EXPECT_EQ(files_in(folder.path() / "meshes"), 0U);
}

TEST(gmsh_mesher, a_stop_while_it_works_is_said_to_be_one) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh"};
  request.program = in_place_of_gmsh(folder, "kill -INT $$");
  EXPECT_WORDS(words_of<MachineError>(request), "stopped while gmsh was meshing it. The run has not started");
}

/// What is said of a geometry with this line in it; Gmsh is not reached.
std::string refused(const TemporaryFolder& folder, const std::string& line) {
  const std::filesystem::path file = folder.write("box.geo", line + box);
  return words_of<UserError>({file, folder / "made.msh", {}, 1, 3, "no-such-program-of-a-test"});
}

TEST(gmsh_mesher, a_geometry_that_does_more_than_describe_shapes_is_refused) {
  const TemporaryFolder folder;
  folder.write("shape.geo", "Point(1) = {0, 0, 0};\n");
  folder.write("evil.geo", "\nSystemCall \"id\";\n");
  folder.write("dash.stl", "solid\nendsolid\n");
  for (const char* line : {"SystemCall \"id > PWNED\";",
                           "System \"id\";",
                           "  NonBlockingSystemCall(\"id\");",
                           "OnelabRun(\"a\", \"id\");",
                           "Printf(\"overwritten\") > \"victim.txt\";",
                           "Printf(\"(%g\", Max(1, 2) ) /* c */ >> \"victim.txt\";",
                           "Error(\"x\") > \"v\";",
                           "Print \"picture.png\";",
                           "Save \"a.msh\";",
                           "CreateDir \"a\";",
                           "Merge \"/etc/passwd\";",
                           "Merge \"../a.stl\";",
                           "Merge StrCat(\"a\", \".geo\");",
                           "Include \"evil.geo\";",
                           "Merge 'evil.geo';",
                           "Include \"dash.stl\\",
                           "Field[1] = ExternalProcess;",
                           "Field[1].CommandLine = \"id\";",
                           "Field[1].FileName = \"/dev/zero\";",
                           "Plugin(Homology).Run;",
                           "Solver.Executable0 = \"id\";",
                           "General.OptionsFileName = \"x\";",
                           "Sleep 100;",
                           "a() = ListFromFile(\"/dev/zero\");",
                           "/* \" */ Save \"a\"; /* \" */",
                           "// '\nSave \"a\"; // '",
                           "Field[1] = S2N[\"External\"];"})
    EXPECT_WORDS(refused(folder, line), "--trust-geometry") << line;
  folder.write("box.geo.opt", "Save \"a\";");
  EXPECT_WORDS(refused(folder, ""), "box.geo.opt:1: it uses Save");
}

TEST(gmsh_mesher, a_geometry_that_describes_shapes_reaches_gmsh) {
  const TemporaryFolder folder;
  folder.write("shape.geo", "Point(7) = {0, 0, 0};\n");
  folder.write("a.stl", "solid\nendsolid\n");
  for (const char* line :
       {"Include \"shape.geo\";", "Merge \"a.stl\";", "Printf(\"%g > 1\", 2 > 1);", "Physical Point(\"Save\") = {1};",
        "// Save \"a\"\n", "Print.Background = 1;", "/* SystemOfUnits */ name = \"a' Save\";"})
    EXPECT_WORDS(refused(folder, line), "no-such-program-of-a-test") << line;
  setenv("SAZARE_TRUST_GEOMETRY", "1", 1);
  EXPECT_WORDS(refused(folder, "SystemCall \"id\";"), "no-such-program-of-a-test");
  unsetenv("SAZARE_TRUST_GEOMETRY");
}

/// Gmsh would leave out what stands there.
TEST(gmsh_mesher, a_last_line_without_an_end_is_refused) {
  const TemporaryFolder folder;
  const std::filesystem::path file =
      folder.write("cut.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nPhysical Volume(\"box\") = {1};");
  EXPECT_WORDS(words_of<UserError>(MeshRequest{file, folder.path() / "cut.msh"}), "the last line does not end");
}

TEST(gmsh_mesher, missing_program) {
  const TemporaryFolder folder;
  const MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh", {}, 1, 3, "no-such-gmsh"};
  const std::string words = words_of<UserError>(request);
  EXPECT_WORDS(words, "box.geo: meshing it requires the program 'no-such-gmsh', which is not installed");
  EXPECT_WORDS(words, "apt install gmsh");
}

TEST(gmsh_mesher, wrong_geometry_shows_the_words_of_gmsh) {
  const TemporaryFolder folder;
  const MeshRequest request{folder.write("bad.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0;\n"),
                            folder.path() / "box.msh"};
  const std::string words = words_of<UserError>(request);
  EXPECT_WORDS(words, "bad.geo: gmsh could not mesh it. Its last messages:");
  EXPECT_WORDS(words, "line 2");
  EXPECT_WORDS(words, "syntax error");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(gmsh_mesher, failure_leaves_the_former_mesh) {
  const TemporaryFolder folder;
  const MeshRequest request{folder.write("bad.geo", "Box(1) = {"), folder.write("box.msh", "former")};
  EXPECT_NE(words_of<UserError>(request), "");
  EXPECT_EQ(test::read_text(folder.path() / "box.msh"), "former");
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(gmsh_mesher, missing_geometry) {
  EXPECT_WORDS(words_of<UserError>({"no/such.geo", "x.msh"}), "no/such.geo: there is no such geometry file");
}

TEST(gmsh_mesher, parameter_unknown_to_the_geometry) {
  const TemporaryFolder folder;
  MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh", {{"dept", 2}}};
  EXPECT_WORDS(words_of<UserError>(request), "the parameter 'dept' does not occur in this file");
  request.parameters = {{"-o", 1}};
  EXPECT_WORDS(words_of<UserError>(request), "the parameter '-o' is not a valid name");
  request.parameters = {{"depth", std::nan("")}};
  EXPECT_WORDS(words_of<UserError>(request), "should be a finite number");
  request = {folder.write("fixed.geo", "depth = 1;\n"), folder.path() / "box.msh", {{"depth", 2}}};
  EXPECT_WORDS(words_of<UserError>(request), "has no effect because the file sets it itself");
}

TEST(gmsh_mesher, size_factor_not_positive) {
  const TemporaryFolder folder;
  const MeshRequest request{folder.write("box.geo", box), folder.path() / "box.msh", {}, 0};
  EXPECT_WORDS(words_of<UserError>(request), "the size factor is 0");
}

TEST(gmsh_mesher, mesh_folder_that_cannot_be_made) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const MeshRequest request{folder.write("box.geo", box), folder.path() / "file" / "box.msh"};
  EXPECT_WORDS(words_of<MachineError>(request), "box.msh: cannot be written");
}

}  // namespace
}  // namespace sazare::geometry
