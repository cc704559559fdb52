#include "host/simulation/study/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace astro::simulation::study {
namespace {

TEST(InParallel, DoesEachPieceOnceWhateverTheThreads) {
  for (const int jobs : {1, 2, 7, 200}) {
    std::vector<std::atomic<int>> times(100);
    int seen = 0;
    in_parallel(
        100, jobs, [&](int i) { ++times[static_cast<std::size_t>(i)]; }, [&](int done) { seen = done; });
    for (const auto& count : times) EXPECT_EQ(count, 1) << jobs;
    EXPECT_EQ(seen, 100) << "the last look is at the end";
  }
}

TEST(InParallel, NothingToDoIsDoneAtOnce) {
  in_parallel(0, 4, [](int) { FAIL(); });
}

TEST(InParallel, WhatThePieceThrowsComesOutAndNoMoreBegin) {
  std::atomic<int> begun = 0;
  const auto work = [&](int i) {
    ++begun;
    if (i == 3) throw std::runtime_error("piece 3");
  };
  try {
    in_parallel(1000000, 2, work);
    FAIL() << "nothing came out";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "piece 3");
  }
  EXPECT_LT(begun, 1000000);
}

TEST(InParallel, TheCallerCanEndIt) {
  std::atomic<bool> asked = false;
  std::atomic<int> begun = 0;
  const auto work = [&](int) {
    ++begun;
    asked.wait(false);  // pieces continue until an end is requested
  };
  const auto meanwhile = [&](int) {
    asked = true;
    asked.notify_all();
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(in_parallel(1000000000, 2, work, meanwhile), std::runtime_error);
  EXPECT_LT(begun, 1000000000);
}

}  // namespace
}  // namespace astro::simulation::study
