#include "tests/common/rows/journals.hpp"

#include "strainwave/common/rows/merge.hpp"

namespace strainwave {
namespace {

/// One journal for each shard of a study of 1000 rows.
std::vector<std::filesystem::path> write_shards(const TemporaryFolder& folder, std::uint32_t shards) {
  std::filesystem::create_directories(folder.path / "shards");
  std::vector<std::filesystem::path> journals;
  for (std::uint32_t s = 0; s < shards; ++s) {
    JournalHeader header = test_header();
    header.shard = s;
    header.shards = shards;
    journals.push_back(shard_journal(folder.path, s, shards));
    write_journal(journals.back().string(), header, 0, 100);
  }
  return journals;
}

bool same(const RowTable& a, const RowTable& b) {
  return std::ranges::equal(a.status(), b.status()) && std::ranges::equal(a.values(), b.values()) &&
         a.messages() == b.messages();
}

TEST(Merge, AnyNumberOfShardsGivesTheSameTable) {
  const TemporaryFolder one, three, many;
  const Merged whole = merge_journals(write_shards(one, 1));
  EXPECT_EQ(whole.table.done(), 1000U);
  EXPECT_TRUE(same(whole.table, merge_journals(write_shards(three, 3)).table));
  EXPECT_TRUE(same(whole.table, merge_journals(write_shards(many, 64)).table));
}

TEST(Merge, TheNumberOfShardsMayChangeMidway) {
  const TemporaryFolder folder;
  write_shards(folder, 2);
  std::filesystem::remove(shard_journal(folder.path, 1, 2));
  write_shards(folder, 5);
  std::filesystem::remove(shard_journal(folder.path, 2, 5)); // its even blocks are in shard 0 of 2
  const auto [fault, sentence] = refusal([&] { merge_journals(shard_journals(folder.path)); });
  EXPECT_EQ(fault, JournalFault::gaps);
  EXPECT_EQ(sentence, "100 of 1000 rows are missing, the first is row 70; run again: --shard 2/5 (100 rows)");
}

TEST(Merge, GapsAreRefusedUnlessAllowed) {
  const TemporaryFolder folder;
  auto journals = write_shards(folder, 4);
  journals.erase(journals.begin() + 2);
  const auto [fault, sentence] = refusal([&] { merge_journals(journals); });
  EXPECT_EQ(fault, JournalFault::gaps);
  EXPECT_EQ(sentence, "250 of 1000 rows are missing, the first is row 20; run again: --shard 2/4 (250 rows)");
  const Merged merged = merge_journals(journals, true);
  EXPECT_EQ(merged.missing_rows, 250U);
  EXPECT_EQ(merged.table.status()[20], row_missing);
}

TEST(Merge, OtherPlansAndModelsAreRefused) {
  const TemporaryFolder folder;
  auto journals = write_shards(folder, 2);
  JournalHeader header = test_header();
  header.plan_hash = 9;
  journals.emplace_back(folder.file("other-plan"));
  write_journal(journals.back().string(), header, 0, 1);
  EXPECT_EQ(refusal([&] { merge_journals(journals); }).first, JournalFault::other_plan);
  journals.pop_back();
  header = test_header();
  header.model_hash = 9;
  journals.emplace_back(folder.file("other-model"));
  write_journal(journals.back().string(), header, 0, 1);
  EXPECT_EQ(refusal([&] { merge_journals(journals); }).first, JournalFault::other_model);
}

TEST(Merge, ContradictingRowsAreNamedWithBothFiles) {
  const TemporaryFolder folder;
  auto journals = write_shards(folder, 1);
  journals.emplace_back(folder.file("again"));
  {
    JournalWriter journal(journals.back().string(), test_header(), ignore_records());
    append_block(journal, test_block(3)); // the same
    RowBlock block = test_block(5);
    block.seconds = 99.0; // times may differ
    append_block(journal, block);
    block = test_block(4);
    block.values[4] += 1e-16 * block.values[4] + 1e-14;
    append_block(journal, block);
  }
  const auto [fault, sentence] = refusal([&] { merge_journals(journals); });
  EXPECT_EQ(fault, JournalFault::contradiction);
  EXPECT_EQ(sentence,
            "row 42 differs between " + journals[0].string() + " and " + journals[1].string() +
                ": they were not made by one binary on one kind of processor; run one of them again");
}

TEST(Merge, AnotherBinaryIsNoted) {
  const TemporaryFolder folder;
  auto journals = write_shards(folder, 2);
  JournalHeader header = test_header();
  header.origin = "another build";
  journals.emplace_back(folder.file("z"));
  write_journal(journals.back().string(), header, 0, 1);
  const Merged merged = merge_journals(journals);
  ASSERT_EQ(merged.notes.size(), 1U);
  EXPECT_NE(merged.notes[0].find("another build"), std::string::npos);
}

} // namespace
} // namespace strainwave
