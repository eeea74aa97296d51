// A writer is killed with SIGKILL at a random moment; what it had synced must be there, bit for bit, and the
// next writer must be able to go on.
#include "tests/common/rows/journals.hpp"

#include "strainwave/common/sampling/counter_random.hpp"

#include <csignal>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>

namespace strainwave {
namespace {

/// Blocks that the child has handed to a finished sync(), seen by the parent.
struct Synced {
  volatile std::uint64_t synced_blocks;
};

[[noreturn]] void write_until_killed(const std::string& path, std::uint64_t from, Synced& progress) {
  JournalHeader header = test_header();
  header.rows = 100000000;
  JournalWriter journal(path, header, ignore_records(), std::chrono::milliseconds(2));
  for (std::uint64_t b = from;; ++b) {
    append_block(journal, test_block(b));
    if (b % 64 == 63) {
      journal.sync();
      progress.synced_blocks = b + 1;
    }
  }
}

void kill_writers(int times, std::uint64_t seed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("j");
  auto* progress = static_cast<Synced*>(
      ::mmap(nullptr, sizeof(Synced), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  std::uint64_t blocks = 0;
  for (int i = 0; i < times; ++i) {
    progress->synced_blocks = blocks;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
      write_until_killed(path, blocks, *progress);
    const std::uint64_t wait =
        random_bits({seed, RandomPurpose::model}, static_cast<std::uint64_t>(i), 0) % 20000;
    std::this_thread::sleep_for(std::chrono::microseconds(wait));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);

    std::uint64_t next = 0;
    std::vector<std::byte> expected;
    const JournalScan scan = scan_journal(path, [&](RecordKind, std::span<const std::byte> payload) {
      encode_block(test_block(next++), expected);
      ASSERT_TRUE(std::ranges::equal(payload, expected)) << "block " << next - 1;
    });
    ASSERT_GE(scan.records, progress->synced_blocks) << "kill " << i;
    blocks = scan.records;
    if (::testing::Test::HasFatalFailure())
      break;
  }
  ::munmap(progress, sizeof(Synced));
  EXPECT_GT(blocks, 0U);
}

TEST(JournalKill, TenKillsLoseNothingThatWasSynced) {
  kill_writers(10, 1);
}

TEST(JournalKillNightly, TwoHundredKillsLoseNothingThatWasSynced) {
  kill_writers(200, 2);
}

} // namespace
} // namespace strainwave
