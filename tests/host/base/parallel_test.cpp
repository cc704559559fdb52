#include "host/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace astro {
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
  in_parallel(0, [](int) { FAIL(); });
  in_parallel(
      0, 4, [](int) { FAIL(); }, [](int) {});
}

TEST(InParallel, WhatThePieceThrowsComesOutAndNoMoreBegin) {
  std::atomic<int> begun = 0;
  const auto work = [&](int i) {
    ++begun;
    if (i == 3) throw std::runtime_error("piece 3");
  };
  try {
    in_parallel(1000000, 2, work, [](int) {});
    FAIL() << "nothing came out";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "piece 3");
  }
  EXPECT_LT(begun, 1000000);
}

TEST(InParallel, TheFirstOfSeveralFailuresComesOutWhicheverWasSooner) {
  for (int round = 0; round < 200; ++round) {
    std::atomic<bool> later_failed = false;
    const auto work = [&](int i) {
      if (i == 3) {
        later_failed.wait(false);  // on two threads piece 4 fails while piece 3 is under way
        throw std::runtime_error("piece 3");
      }
      if (i == 4) {
        later_failed = true;
        later_failed.notify_all();
        throw std::runtime_error("piece 4");
      }
    };
    try {
      in_parallel(8, 2, work, [](int) {});
      FAIL() << "nothing came out";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "piece 3");
    }
  }
}

TEST(InParallel, APieceThatSharesItsOwnWorkOutDoesItItself) {
  std::atomic<int> elsewhere = 0, pieces = 0;
  in_parallel(
      4, 2,
      [&](int) {
        const auto own = std::this_thread::get_id();
        in_parallel(50, [&](int) {
          ++pieces;
          if (std::this_thread::get_id() != own) ++elsewhere;
        });
      },
      [](int) {});
  EXPECT_EQ(pieces, 200);
  EXPECT_EQ(elsewhere, 0);
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
}  // namespace astro
