#pragma once

/// Columns to and from the checkpoint file.

#include "sazare/core/archive.hpp"
#include "sazare/observe/checkpoint.hpp"

namespace sazare::runs {

class CheckpointSaver final : public Archive {
public:
  explicit CheckpointSaver(observe::CheckpointWriter& out) : out_(&out) {}
  bool reading() const override { return false; }

protected:
  void write(const std::string& name, std::span<const std::byte> bytes) override { out_->add(name, bytes); }
  std::vector<std::byte> read(const std::string&) override { return {}; }

private:
  observe::CheckpointWriter* out_;
};

class CheckpointLoader final : public Archive {
public:
  explicit CheckpointLoader(const observe::CheckpointReader& in) : in_(&in) {}
  bool reading() const override { return true; }

protected:
  void write(const std::string&, std::span<const std::byte>) override {}
  std::vector<std::byte> read(const std::string& name) override { return in_->read(name); }

private:
  const observe::CheckpointReader* in_;
};

}  // namespace sazare::runs
