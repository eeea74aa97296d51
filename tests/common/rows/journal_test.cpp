#include "tests/common/rows/journals.hpp"

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>

namespace strainwave {
namespace {

TEST(RowBlock, ReadsBackWhatWasWritten) {
  const RowBlock block = test_block(4);
  std::vector<std::byte> bytes;
  encode_block(block, bytes);
  RowBlock back;
  decode_block(bytes, back);
  EXPECT_EQ(back.first, block.first);
  EXPECT_EQ(back.seconds, block.seconds);
  EXPECT_EQ(back.status, block.status);
  EXPECT_EQ(back.values, block.values);
  ASSERT_EQ(back.messages.size(), block.messages.size());
  EXPECT_EQ(back.messages[0].text, block.messages[0].text);
}

TEST(RowBlock, RefusesBytesThatContradictThemselves) {
  std::vector<std::byte> bytes;
  encode_block(test_block(4), bytes);
  RowBlock back;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(decode_block(std::span(bytes).first(size), back), JournalError) << size;
  bytes.push_back(std::byte{0});
  EXPECT_THROW(decode_block(bytes, back), JournalError);
}

TEST(Journal, ContinuesWhereItEnded) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 5);
  write_journal(folder.file("j"), test_header(), 5, 9);
  RowTable table(1000, 2, 10);
  const JournalScan scan =
      scan_journal(folder.file("j"), [&](RecordKind, std::span<const std::byte> payload) {
        RowBlock block;
        decode_block(payload, block);
        EXPECT_FALSE(table.insert(block).has_value());
      });
  EXPECT_EQ(*scan.header, test_header());
  EXPECT_EQ(scan.records, 9U);
  EXPECT_TRUE(scan.damage.empty());
  EXPECT_EQ(table.done(), 90U);
  EXPECT_EQ(table.failed(), 13U); // rows 3, 10, … 87
  EXPECT_EQ(table.messages().at(17), "row 17 has no wrap angle");
}

TEST(Journal, ARecordThatIsCutAnywhereIsNamedAndCut) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 2);
  const std::string two = bytes_of(folder.file("j"));
  write_journal(folder.file("j"), test_header(), 2, 3);
  const std::string three = bytes_of(folder.file("j"));
  for (std::size_t size = two.size() + 1; size < three.size(); ++size) {
    put_bytes(folder.file("j"), three.substr(0, size));
    {
      const JournalWriter journal(folder.file("j"), test_header(), ignore_records());
      ASSERT_EQ(journal.found().records, 2U) << size;
      ASSERT_EQ(journal.found().damage, folder.file("j") + ": the last record is torn after 2 records; " +
                                            std::to_string(size - two.size()) + " bytes from byte " +
                                            std::to_string(two.size()) + " on do not count");
    }
    ASSERT_EQ(bytes_of(folder.file("j")), two);
  }
}

TEST(Journal, EveryFlippedByteOfTheLastRecordIsFound) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 2);
  const std::size_t good = bytes_of(folder.file("j")).size();
  write_journal(folder.file("j"), test_header(), 2, 3);
  const std::string three = bytes_of(folder.file("j"));
  for (std::size_t at = good; at < three.size(); ++at) {
    std::string bad = three;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    put_bytes(folder.file("j"), bad);
    const JournalScan scan = scan_journal(folder.file("j"), ignore_records());
    ASSERT_EQ(scan.records, 2U) << at;
    ASSERT_FALSE(scan.damage.empty());
  }
}

TEST(Journal, ZerosAfterAPowerCutAreNoRecords) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 2);
  put_bytes(folder.file("j"), bytes_of(folder.file("j")) + std::string(4096, '\0'));
  const JournalScan scan = scan_journal(folder.file("j"), ignore_records());
  EXPECT_EQ(scan.records, 2U);
  EXPECT_NE(scan.damage.find("what follows is no record"), std::string::npos);
}

TEST(Journal, AHeaderThatWasNeverFinishedIsWrittenAgain) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 1);
  const std::string whole = bytes_of(folder.file("j"));
  for (std::size_t size : {0, 1, 8, 127}) {
    put_bytes(folder.file("j"), whole.substr(0, size));
    write_journal(folder.file("j"), test_header(), 0, 1);
    EXPECT_EQ(bytes_of(folder.file("j")), whole) << size;
  }
}

TEST(Journal, RefusesOtherStudiesAndLeavesThemAsTheyAre) {
  const TemporaryFolder folder;
  const std::string path = folder.file("j");
  write_journal(path, test_header(), 0, 3);
  const std::string before = bytes_of(path);
  const auto fault = [&](auto change) {
    JournalHeader header = test_header();
    change(header);
    const auto result = refusal([&] { const JournalWriter journal(path, header, ignore_records()); });
    EXPECT_EQ(bytes_of(path), before);
    return result;
  };
  EXPECT_EQ(fault([](auto& h) { h.plan_hash = 1; }).second,
            path + " belongs to another plan (0000000000001234, this study has 0000000000000001); take "
                   "another folder");
  EXPECT_EQ(fault([](auto& h) { h.model_hash = 1; }).first, JournalFault::other_model);
  EXPECT_EQ(fault([](auto& h) { h.shards = 4; }).first, JournalFault::other_shape);
  EXPECT_EQ(fault([](auto& h) { h.outputs = 4; }).first, JournalFault::other_shape);
}

TEST(Journal, LeavesFilesAloneThatAreNoJournals) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string("short"), std::string(500, 'x')}) {
    put_bytes(folder.file("j"), text);
    const auto [fault, sentence] =
        refusal([&] { const JournalWriter journal(folder.file("j"), test_header(), ignore_records()); });
    EXPECT_EQ(fault, JournalFault::not_a_journal);
    EXPECT_EQ(bytes_of(folder.file("j")), text);
  }
}

TEST(Journal, ADamagedHeaderIsSaidSo) {
  const TemporaryFolder folder;
  write_journal(folder.file("j"), test_header(), 0, 3);
  std::string bytes = bytes_of(folder.file("j"));
  bytes[20] = static_cast<char>(bytes[20] ^ 1);
  put_bytes(folder.file("j"), bytes);
  const auto [fault, sentence] = refusal([&] { scan_journal(folder.file("j"), ignore_records()); });
  EXPECT_EQ(fault, JournalFault::damaged);
  EXPECT_EQ(sentence,
            folder.file("j") + ": the header is damaged; move the file away and run its shard again");
}

TEST(Journal, ASecondWriterIsRefused) {
  const TemporaryFolder folder;
  JournalWriter first(folder.file("j"), test_header(), ignore_records());
  append_block(first, test_block(0));
  const auto [fault, sentence] =
      refusal([&] { const JournalWriter second(folder.file("j"), test_header(), ignore_records()); });
  EXPECT_EQ(fault, JournalFault::locked);
  EXPECT_EQ(sentence, folder.file("j") + " is being written by another process; wait for it or stop it");
  append_block(first, test_block(1));
  first.sync();
  EXPECT_EQ(scan_journal(folder.file("j"), ignore_records()).records, 2U);
}

TEST(Journal, AFolderThatCannotBeWrittenIsASystemError) {
  EXPECT_THROW(JournalWriter("/proc/no-such-folder/j", test_header(), ignore_records()), std::system_error);
}

// A file-size limit stands for a full disk: the write stops in the middle of a record. In a child, since the
// limit stays.
TEST(Journal, AFullDiskStopsCleanlyAndWholeRecordsStay) {
  const TemporaryFolder folder;
  const std::string path = folder.file("j");
  write_journal(path, test_header(), 0, 3);
  const std::size_t before = bytes_of(path).size();
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{before + 100, before + 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      JournalWriter journal(path, test_header(), ignore_records());
      append_block(journal, test_block(3));
      journal.sync();
    } catch (const std::system_error& error) {
      code = error.code().value() == EFBIG ? 0 : 2;
    }
    ::_exit(code);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  const JournalScan scan = scan_journal(path, ignore_records());
  EXPECT_EQ(scan.records, 3U);
  EXPECT_TRUE(scan.damage.empty());
  EXPECT_EQ(scan.file_bytes, before);
}

} // namespace
} // namespace strainwave
