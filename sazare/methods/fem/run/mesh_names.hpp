#pragma once

#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/interface_split.hpp"

namespace sazare::runs {

/// Looks up what a case names in its mesh, and refuses what is not there.
class MeshNames {
public:
  MeshNames(const cases::CaseSource& source, const geometry::ElementMesh& mesh) : source_(source), mesh_(mesh) {}

  Index region(const std::string& key, const std::string& name) const;

  /// `of_faces`: only a group of faces of elements of the body will do.
  const geometry::ElementGroup& group(const std::string& key, const std::string& name, bool of_faces) const;

  /// A group of faces with nothing behind them. `nothing` does what it is for inside the body, such as "no body can touch it".
  const geometry::ElementGroup& outer_group(const std::string& key, const std::string& name, const std::string& nothing) const;

private:
  const cases::CaseSource& source_;
  const geometry::ElementMesh& mesh_;
};

}  // namespace sazare::runs
