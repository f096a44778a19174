#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <random>

#include "msh_writer.hpp"
#include "sazare/core/error.hpp"
#include "sazare/geometry/gmsh/reader.hpp"

namespace sazare::geometry {
namespace {

using test::MshWriter;
using test::TemporaryFolder;
using test::two_tetrahedra;

/// The words of the UserError of a file with this content; empty when it is accepted.
std::string words_of(const std::string& content, Real scale = 1) {
  const TemporaryFolder folder;
  const auto file = folder.write("bad.msh", content);
  try {
    read_gmsh(file, scale);
    return "";
  } catch (const UserError& error) {
    const std::string words = error.what();
    EXPECT_TRUE(words.starts_with(file.string() + ":")) << words;
    return words;
  }
}

std::string words_of(const std::function<void(MshWriter&)>& spoil) {
  MshWriter mesh = two_tetrahedra();
  spoil(mesh);
  return words_of(mesh.text());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

#define EXPECT_WORDS(words, part) EXPECT_NE((words).find(part), std::string::npos) << "words: " << (words)

TEST(gmsh_reader_errors, missing_file) {
  try {
    read_gmsh("no/such.msh", 1);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_WORDS(std::string(error.what()), "no/such.msh: there is no such mesh file");
  }
}

TEST(gmsh_reader_errors, folder_instead_of_file) {
  const TemporaryFolder folder;
  try {
    read_gmsh(folder.path(), 1);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_WORDS(std::string(error.what()), "is not a file");
  }
}

TEST(gmsh_reader_errors, empty_file) { EXPECT_WORDS(words_of(""), "the mesh file is empty"); }

TEST(gmsh_reader_errors, other_kind_of_file) {
  EXPECT_WORDS(words_of("solid cube\nfacet normal 0 0 1\n"),
               "bad.msh:1: a section such as $Nodes should begin here, not 'solid cube'");
  EXPECT_WORDS(words_of("$Nodes\n1 2 3\n"), "should begin with $MeshFormat");
  EXPECT_WORDS(words_of(std::string("\x7f"
                                    "ELF\x02\x01\0\0",
                                    8)),
               "Is this a Gmsh mesh");
}

TEST(gmsh_reader_errors, other_version) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.version = "2.2"; });
  EXPECT_WORDS(words, "bad.msh:2: $MeshFormat: Gmsh format 2.2: Sazare reads 4.1");
  EXPECT_WORDS(words, "gmsh OLD.msh -save -format msh41 -o NEW.msh");
}

TEST(gmsh_reader_errors, other_byte_order) {
  const std::string binary = two_tetrahedra().binary();
  const std::string one("\x01\0\0\0", 4);
  EXPECT_WORDS(words_of(replaced(binary, one, std::string("\0\0\0\x01", 4))), "another byte order");
}

TEST(gmsh_reader_errors, other_number_size) {
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "4.1 0 8", "4.1 0 4")), "numbers of 4 bytes");
}

TEST(gmsh_reader_errors, second_order) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.elements[2] = {11, 3, 1, {1, 2, 3, 4, 5, 1, 2, 3, 4, 5}}; });
  EXPECT_WORDS(words, "$Elements: element 103 is of type 11 (10-node tetrahedron, second order)");
  EXPECT_WORDS(words, "Mesh.ElementOrder = 1");
}

TEST(gmsh_reader_errors, other_shapes) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.elements[2] = {5, 3, 1, {1, 2, 3, 4, 5, 1, 2, 3}}; });
  EXPECT_WORDS(words, "element 103 is of type 5 (8-node hexahedron)");
  EXPECT_WORDS(words, "Recombine");
  EXPECT_WORDS(words_of([](MshWriter& mesh) { mesh.elements[2].type = 99; }), "type 99, which Sazare does not read");
}

TEST(gmsh_reader_errors, no_tetrahedra) {
  EXPECT_WORDS(words_of([](MshWriter& mesh) { mesh.elements.resize(2); }), "$Elements: there are no tetrahedra");
}

TEST(gmsh_reader_errors, tetrahedra_without_group) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.volume_groups[2] = {}; });
  EXPECT_WORDS(words, "the 1 tetrahedra of volume 2 (the first is element 104) are in no physical group");
  EXPECT_WORDS(words, "Physical Volume(\"NAME\") = {2};");
}

TEST(gmsh_reader_errors, volume_in_two_groups) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.volume_groups[1] = {8, 9}; });
  EXPECT_WORDS(words, "volume 1 is in 2 physical groups: 'left', 'right'");
}

TEST(gmsh_reader_errors, inverted_element) {
  const std::string words = words_of([](MshWriter& mesh) { std::swap(mesh.elements[3].nodes[0], mesh.elements[3].nodes[1]); });
  EXPECT_WORDS(words, "1 element inverted, with a negative volume: 104 (volume -0.166667 m3)");
}

TEST(gmsh_reader_errors, degenerate_element) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.elements[3].nodes = {1, 2, 3, 5}; });
  EXPECT_WORDS(words, "1 element degenerate, with almost no volume: 104 (volume 0 m3)");
  EXPECT_WORDS(words_of([](MshWriter& mesh) { mesh.elements[3].nodes = {2, 2, 3, 5}; }), "104 (volume 0 m3)");
}

TEST(gmsh_reader_errors, ten_elements_are_listed_and_the_rest_counted) {
  const std::string words = words_of([](MshWriter& mesh) {
    for (int i = 0; i < 13; ++i) mesh.elements.push_back({4, 3, 1, {2, 1, 3, 4}});
  });
  EXPECT_WORDS(words, "13 elements inverted");
  EXPECT_WORDS(words, "114 (volume -0.166667 m3) and 3 more");
  EXPECT_EQ(words.find("115 (volume"), std::string::npos);
}

TEST(gmsh_reader_errors, same_element_twice) {
  const std::string words = words_of([](MshWriter& mesh) { mesh.elements.push_back({4, 3, 2, {2, 5, 3, 4}}); });
  EXPECT_WORDS(words, "elements 103, 104 and 105 share one face");
}

TEST(gmsh_reader_errors, element_number_twice) {
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "\n104 ", "\n103 ")), "two tetrahedra have the number 103");
}

TEST(gmsh_reader_errors, elements_on_one_side_of_their_face) {
  const std::string words = words_of([](MshWriter& mesh) {
    mesh.nodes.emplace_back(0.1, 0.1, 0.05);
    mesh.elements[1].nodes = {1, 2, 4};
    mesh.elements[3].nodes = {6, 2, 3, 4};
  });
  EXPECT_WORDS(words, "1 pair of elements lie on the same side of the face they share");
  EXPECT_WORDS(words, "103 and 104");
}

TEST(gmsh_reader_errors, coordinates_not_finite) {
  for (const char* value : {"nan", "inf", "-inf", "1e999"}) {
    const std::string words = words_of(replaced(two_tetrahedra().text(), "0 0 1 \n", std::string("0 0 ") + value + " \n"));
    EXPECT_WORDS(words, "node 4 has a coordinate that is not a finite number");
  }
}

TEST(gmsh_reader_errors, scale_not_positive) {
  EXPECT_WORDS(words_of(two_tetrahedra().text(), 0), "the scale is 0");
  EXPECT_WORDS(words_of(two_tetrahedra().text(), std::nan("")), "the scale is nan");
}

TEST(gmsh_reader_errors, unknown_node) {
  EXPECT_WORDS(words_of([](MshWriter& mesh) { mesh.elements[3].nodes[1] = 77; }),
               "element 104 names node 77, which is not in $Nodes");
}

TEST(gmsh_reader_errors, node_number_twice) {
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "4 \n5 \n", "4 \n4 \n")), "node 4 occurs twice");
}

TEST(gmsh_reader_errors, surface_away_from_the_body) {
  const std::string words = words_of([](MshWriter& mesh) {
    mesh.nodes.emplace_back(9, 9, 9);
    mesh.elements[1].nodes = {2, 5, 6};
  });
  EXPECT_WORDS(words, "triangle 102 of the surface group 'floor' is on no tetrahedron (node 6)");
}

TEST(gmsh_reader_errors, words_instead_of_numbers) {
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "0 0 1 \n", "0 x 1 \n")),
               "$Nodes: a node's coordinate should be a number, not 'x'");
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "103 1 2 3 4", "103 1 2.5 3 4")),
               "an element's node should be a whole number, not '2.5'");
}

TEST(gmsh_reader_errors, announced_numbers_do_not_hold) {
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "$Nodes\n1 5", "$Nodes\n1 6")), "announces 6 nodes but has 5");
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "$Elements\n4 4", "$Elements\n4 5")),
               "announces 5 elements but has 4");
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "$Nodes\n1 5", "$Nodes\n1 900000000")), "space for");
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "$Elements\n4 4", "$Elements\n3 3")), "$EndElements should be here");
  EXPECT_WORDS(words_of(replaced(two_tetrahedra().text(), "$Elements\n4 4", "$Elements\n5 5")),
               "the section ends where an element block's dimension should be");
}

TEST(gmsh_reader_errors, missing_section) {
  std::string text = two_tetrahedra().text();
  EXPECT_WORDS(words_of(text.substr(0, text.find("$Elements"))), "the section $Elements is missing: the file is truncated");
  EXPECT_WORDS(words_of(text.substr(0, text.find("$Nodes"))), "the section $Nodes is missing");
}

TEST(gmsh_reader_errors, section_twice) {
  const std::string text = two_tetrahedra().text();
  const auto begin = text.find("$Nodes");
  const auto end = text.find("$Elements");
  EXPECT_WORDS(words_of(text.substr(0, end) + text.substr(begin)), "the section occurs twice in the file");
}

TEST(gmsh_reader_errors, partitioned) {
  std::string text = two_tetrahedra().text();
  text.insert(text.find("$Nodes"), "$PartitionedEntities\n2\n$EndPartitionedEntities\n");
  EXPECT_WORDS(words_of(text), "the mesh is partitioned");
}

/// Two bodies with a common plane x = 1 and nodes of their own on it; `named` puts both sides in a group.
MshWriter two_bodies(bool named, const Vector3& offset) {
  MshWriter mesh;
  mesh.names = {{3, 8, "rock"}, {2, 7, "left"}, {2, 6, "right"}};
  mesh.volume_groups = {{1, {8}}};
  mesh.surface_groups = {{1, {7}}, {2, {6}}};
  mesh.nodes = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 0, 0}, {1, 0.1, 0.1}, {1, 2.1, 0.1}, {1, 0.1, 2.1}, {3, 0, 0}};
  for (std::size_t i = 4; i < 8; ++i) mesh.nodes[i] += offset;
  mesh.elements = {{4, 3, 1, {4, 1, 2, 3}}, {4, 3, 1, {8, 5, 7, 6}}};
  if (named) {
    mesh.elements.push_back({2, 2, 1, {1, 2, 3}});
    mesh.elements.push_back({2, 2, 2, {5, 6, 7}});
  }
  return mesh;
}

TEST(gmsh_reader_errors, interface_that_does_not_conform) {
  const std::string words = words_of(two_bodies(false, Vector3::Zero()).text());
  EXPECT_WORDS(words, "1 pair of elements touch along a face without sharing its nodes");
  EXPECT_WORDS(words, "101 and 102");
  EXPECT_WORDS(words, "BooleanFragments");
}

TEST(gmsh_reader_errors, duplicate_nodes_at_one_place) {
  MshWriter mesh = two_tetrahedra();
  mesh.nodes.insert(mesh.nodes.end(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  mesh.elements[3].nodes = {6, 5, 7, 8};
  mesh.elements.erase(mesh.elements.begin() + 1);
  EXPECT_WORDS(words_of(mesh.text()), "102 and 103");
}

TEST(gmsh_reader_errors, interface_named_on_both_sides_is_meant) {
  EXPECT_EQ(words_of(two_bodies(true, Vector3::Zero()).text()), "");
}

TEST(gmsh_reader_errors, bodies_apart_or_side_by_side_do_not_touch) {
  EXPECT_EQ(words_of(two_bodies(false, Vector3(1e-3, 0, 0)).text()), "");  // a gap
  EXPECT_EQ(words_of(two_bodies(false, Vector3(0, 0.91, 0)).text()), "");  // beside each other in one plane
  EXPECT_NE(words_of(two_bodies(false, Vector3(0, 0.7, 0)).text()), "");   // a corner overlaps
}

TEST(gmsh_reader_errors, touching_faces_of_very_different_size_are_found) {
  MshWriter mesh = two_bodies(false, Vector3::Zero());
  for (std::size_t i = 0; i < 4; ++i) mesh.nodes[i] = Vector3(1, 0.3, 0.3) + 1e-4 * (mesh.nodes[i] - Vector3(1, 0, 0));
  EXPECT_WORDS(words_of(mesh.text()), "101 and 102");
}

/// Every prefix and many changed bytes: accepted or refused in words, never a crash or another exception.
void expect_refused_or_read(const std::filesystem::path& file, const std::string& content, bool must_refuse) {
  std::ofstream(file, std::ios::binary) << content;
  try {
    read_gmsh(file, 1);
    EXPECT_FALSE(must_refuse) << content.size();
  } catch (const UserError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
  }
}

TEST(gmsh_reader_errors, small_mesh_cut_anywhere) {
  const TemporaryFolder folder;
  for (const std::string& content : {two_tetrahedra().text(), two_tetrahedra().binary()}) {
    // The last byte is the line's end after $EndElements: without it the file is whole.
    for (std::size_t length = 0; length + 1 < content.size(); ++length) {
      expect_refused_or_read(folder.path() / "cut.msh", content.substr(0, length), true);
    }
  }
}

TEST(gmsh_reader_errors, slab_cut_at_many_places) {
  const TemporaryFolder folder;
  const std::string content = test::read_text("cases/free-face-blast/slab.msh");
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    expect_refused_or_read(folder.path() / "cut.msh", content.substr(0, random() % (content.size() - 1)), true);
  }
}

TEST(gmsh_reader_errors, changed_bytes) {
  const TemporaryFolder folder;
  std::mt19937_64 random(4);
  for (const std::string& original : {two_tetrahedra().text(), two_tetrahedra().binary()}) {
    for (int i = 0; i < 1500; ++i) {
      std::string content = original;
      for (std::size_t change = 0; change <= random() % 3; ++change) {
        content[random() % content.size()] = static_cast<char>(random() % 256);
      }
      expect_refused_or_read(folder.path() / "changed.msh", content, false);
    }
  }
}

}  // namespace
}  // namespace sazare::geometry
