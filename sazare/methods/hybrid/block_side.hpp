#pragma once

/// Blocks on the bodies' side of a coupling. A window is a whole number of base steps.

#include <optional>

#include "sazare/core/memory_archive.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/surface_contacts.hpp"
#include "sazare/methods/hybrid/body_side.hpp"
#include "sazare/methods/hybrid/slab_surface.hpp"

namespace sazare::methods::hybrid {

class BlockSide final : public BodySide {
public:
  /// `contacts` are a term of the simulation; both must outlive the side. `can_return`: to a window's beginning, for which the
  /// blocks are copied.
  BlockSide(levels::Simulation<3>& simulation, methods::blocks::SurfaceContacts& contacts, bool can_return = true)
      : simulation_(&simulation), contacts_(&contacts), can_return_(can_return) {}

  void attach(const coupling::SurfaceShape& shape) override;
  coupling::SurfaceForce start() override;
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) override;
  void take_back() override;
  std::int64_t windows() const override { return course_.windows(); }
  std::int64_t steps_per_window() const override { return course_.steps(); }
  void columns(Archive& archive) override { course_.columns(archive); }

private:
  void go_back();

  levels::Simulation<3>* simulation_;
  methods::blocks::SurfaceContacts* contacts_;
  bool can_return_;
  WindowCourse course_;
  SlabSurface surface_;
  std::optional<MemoryArchive> saved_;  ///< the blocks at the last window's beginning
};

}  // namespace sazare::methods::hybrid
