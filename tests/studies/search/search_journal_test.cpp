// The lasting store of a search: what is written is read back, and a search that was stopped or killed ends
// with the bits of an uninterrupted one.

#include "strainwave/studies/search/journal.hpp"

#include "tests/studies/study_shell.hpp"

namespace strainwave {
namespace {

Evaluation some_evaluation() {
  Evaluation e;
  e.ok = true;
  e.status = "ok";
  e.values = {1.5, std::nan(""), -0.25};
  e.pieces = {3.0, 4.0};
  e.certificate.equilibrium = 1e-12;
  return e;
}

TEST(SearchJournal, APointIsReadBackAsItWas) {
  const std::vector<double> x{0.1, 7.0};
  const Evaluation e = some_evaluation();
  std::vector<std::byte> bytes;
  encode_point({.x = x, .evaluation = &e, .seconds = 0.5}, bytes);
  int found = 0;
  decode_point(bytes, [&](const PointNews& news) {
    ++found;
    EXPECT_EQ(std::vector<double>(news.x.begin(), news.x.end()), x);
    ASSERT_NE(news.evaluation, nullptr);
    EXPECT_TRUE(news.evaluation->ok);
    EXPECT_EQ(news.evaluation->values[0], 1.5);
    EXPECT_TRUE(std::isnan(news.evaluation->values[1]));
    EXPECT_EQ(news.evaluation->pieces, e.pieces);
    EXPECT_EQ(news.evaluation->certificate.equilibrium, 1e-12);
    EXPECT_EQ(news.seconds, 0.5);
  });
  EXPECT_EQ(found, 1);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(decode_point(std::span(bytes).first(size), [](const PointNews&) {}), JournalError) << size;
}

/// f = x², and how often it was asked.
struct Square : Evaluator {
  std::span<const Response> responses() const override {
    static const std::vector<Response> all{{"f", "", "a number"}};
    return all;
  }
  Evaluation evaluate(std::span<const double> x) override {
    ++values;
    Evaluation e;
    e.ok = x[0] < 5.0;
    e.status = e.ok ? "ok" : "no_wrap";
    e.message = e.ok ? "" : "too large";
    if (e.ok)
      e.values = {x[0] * x[0]};
    return e;
  }
  std::vector<double> gradient(std::span<const double> x) override {
    ++gradients;
    return {2.0 * x[0]};
  }
  int values = 0, gradients = 0;
};

TEST(SearchJournal, ValuesAndSlopesOfAnEarlierRunAreAnsweredFromIt) {
  const TemporaryFolder folder;
  const auto path = folder / "search.journal";
  const std::vector<double> a{2.0}, b{9.0};
  {
    Square inner;
    EvaluationStore store(inner);
    SearchJournal journal(path, 1, 2, store);
    (void)store.evaluate(a);
    (void)store.gradient(a);
    (void)store.gradient(a);
    (void)store.evaluate(b);
    EXPECT_EQ(inner.gradients, 1);
    journal.sync();
  }
  Square inner;
  EvaluationStore store(inner);
  const SearchJournal journal(path, 1, 2, store);
  EXPECT_EQ(store.evaluate(a).values, (std::vector{4.0}));
  EXPECT_EQ(store.gradient(a), (std::vector{4.0}));
  EXPECT_EQ(store.evaluate(b).message, "too large");
  EXPECT_EQ(inner.values + inner.gradients, 0);
  EXPECT_EQ(store.counts().known, 2u);
  EXPECT_EQ(store.counts().failed, 1u);
  EXPECT_EQ(store.counts().done, 0u);
  EXPECT_EQ(store.points().size(), 2u);
}

TEST(SearchJournal, OfAnotherModelIsRefused) {
  const TemporaryFolder folder;
  Square inner;
  EvaluationStore store(inner);
  { const SearchJournal journal(folder / "j", 1, 2, store); }
  EXPECT_THROW(SearchJournal(folder / "j", 1, 3, store), JournalError);
  EXPECT_THROW(SearchJournal(folder / "j", 3, 2, store), JournalError);
}

class SearchCommand : public StudyShell {
protected:
  /// One variable on a coarse cup.
  void write_search(int budget, const std::string& more = "", int phases = 1) {
    folder.write("seed.toml", file_text(gallery + "seed.toml"));
    folder.write("search.toml", fmt::format(R"(kind = "optimize"
gear = "seed.toml"
[override]
mesh.per_pitch = 3
mesh.along_face = 2
mesh.along_wall = 4
mesh.diaphragm = 3
mesh.tooth_height = 1
[[load_case]]
torque_nm = 7.0
phases = {}
[[variable]]
path = "flank_modification.flexspline.tip_relief_um"
lower = 0.0
upper = 15.0
[objective]
output = "peak_force_n"
[method]
budget = {}
{})",
                                            phases, budget, more));
  }
};

TEST_F(SearchCommand, StoppedSearchesGoOnToTheBitsOfAnUninterruptedOne) {
  write_search(200, "", 6); // long enough to be stopped
  ASSERT_EQ(shell("PROGRAM study run search.toml --out whole").code, 0);
  int stopped = 0;
  for (int i = 0; i < 200 && shell("PROGRAM study run search.toml --out parts --time-limit 0.3").code == 75;
       ++i)
    ++stopped;
  EXPECT_GT(stopped, 0);
  const End last = shell("PROGRAM study run search.toml --out parts --json --threads 1");
  ASSERT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.json()["evaluations"]["done"], 0);
  EXPECT_TRUE(identical("whole", "parts"));
  EXPECT_EQ(file_text((folder / "whole/best.toml").string()),
            file_text((folder / "parts/best.toml").string()));
}

TEST_F(SearchCommand, AnEvaluationIsReproducedByItsNumber) {
  write_search(20);
  ASSERT_EQ(shell("PROGRAM study run search.toml --out a").code, 0);
  const End row = shell("PROGRAM eval --from a --index 3 --json --gear row.toml");
  ASSERT_EQ(row.code, 0) << row.err;
  EXPECT_EQ(row.json()["same_as_recorded"], true);
  const End analysis = shell("PROGRAM analyze row.toml --json");
  EXPECT_EQ(analysis.json()["load"][0]["peak_force_n"], row.json()["outputs"]["peak_force_n"]);
  EXPECT_EQ(shell("PROGRAM eval --from a --index 9999").code, 2);
}

TEST_F(SearchCommand, ASmallBudgetIsKept) {
  for (const int budget : {1, 2, 3, 4, 7, 10, 20}) {
    write_search(budget);
    const std::string out = fmt::format("b{}", budget);
    const End end = shell(fmt::format("PROGRAM study run search.toml --out {} --json", out));
    const auto json = end.json();
    // the three parts of a survey and the unmodified gear have one point each, however small the budget
    EXPECT_LE(json["evaluations"]["done"].get<int>(), std::max(budget, 4)) << budget;
  }
}

TEST_F(SearchCommand, TooManyFailedEvaluationsEndWith3) {
  write_search(24, "[limits]\nfailure_share = 0.0\n[[constraint]]\noutput = \"peak_force_n\"\nmax = 1e9\n");
  const std::string text = file_text((folder / "search.toml").string());
  // eccentricities beyond what the disc can wrap fail
  folder.write("search.toml",
               edited(edited(text, "flank_modification.flexspline.tip_relief_um\"\nlower = 0.0\nupper = 15.0",
                             "wave_generator.eccentricity_mm\"\nlower = 0.55\nupper = 12.0"),
                      "budget = 24", "budget = 24"));
  const End end = shell("PROGRAM study run search.toml --out a");
  EXPECT_EQ(end.code, 3) << end.err;
  EXPECT_NE(end.err.find("more than the share of 0"), std::string::npos) << end.err;
}

} // namespace
} // namespace strainwave
