#pragma once

/// Members of records in a checkpoint: one column for all records, a list of each behind that of the one before.

#include <cstdint>
#include <string>
#include <vector>

#include "sazare/core/archive.hpp"

namespace sazare {

/// A list that every record has, as columns NAME and NAME_sizes.
template <class Record, class Item>
void archive_lists(Archive& archive, const std::string& name, std::vector<Record>& records, std::vector<Item> Record::*member) {
  std::vector<std::int64_t> sizes;
  std::vector<Item> all;
  for (const Record& record : records) {
    const std::vector<Item>& list = record.*member;
    sizes.push_back(static_cast<std::int64_t>(list.size()));
    all.insert(all.end(), list.begin(), list.end());
  }
  archive(name + "_sizes", sizes);
  archive(name, all);
  auto next = all.begin();
  for (std::size_t i = 0; archive.reading() && i < records.size(); ++i) {
    (records[i].*member).assign(next, next + sizes[i]);
    next += sizes[i];
  }
}

/// A plain member of every record.
template <class Record, class Item>
void archive_members(Archive& archive, const std::string& name, std::vector<Record>& records, Item Record::*member) {
  std::vector<Item> all;
  for (const Record& record : records) all.push_back(record.*member);
  archive(name, all);
  for (std::size_t i = 0; i < records.size(); ++i) records[i].*member = all[i];
}

}  // namespace sazare
