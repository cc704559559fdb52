#include "host/base/elimination.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdio>
#include <random>
#include <vector>

// Against the dense equations of all unknowns, in which nothing is eliminated.
namespace astro {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr int kSharedUnknowns = 5, kOwnUnknowns = 3, kGroups = 4;
constexpr int kDense = kSharedUnknowns + kGroups * kOwnUnknowns;
// Forty random rows in each group leave a condition number of some hundreds.
constexpr double kRoundingOfGroups = 1e-11;

struct Equations {
  MatrixXd information = MatrixXd::Zero(kDense, kDense);
  VectorXd gradient = VectorXd::Zero(kDense);
};

Equations random_equations(unsigned seed) {
  std::printf("seed %u\n", seed);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Equations all;
  for (int group = 0; group < kGroups; ++group)
    for (int row = 0; row < 40; ++row) {
      VectorXd j = VectorXd::Zero(kDense);
      for (int i = 0; i < kSharedUnknowns; ++i) j[i] = normal(random);
      for (int i = 0; i < kOwnUnknowns; ++i) j[kSharedUnknowns + group * kOwnUnknowns + i] = normal(random);
      all.information += j * j.transpose();
      all.gradient += j * normal(random);
    }
  return all;
}

template <int Shared>
std::vector<Elimination<Shared, kOwnUnknowns>> groups_of(const Equations& all) {
  std::vector<Elimination<Shared, kOwnUnknowns>> groups;
  for (int group = 0; group < kGroups; ++group) {
    const int at = kSharedUnknowns + group * kOwnUnknowns;
    groups.push_back({all.information.block<kOwnUnknowns, kOwnUnknowns>(at, at),
                      all.information.block<kSharedUnknowns, kOwnUnknowns>(0, at),
                      all.gradient.segment<kOwnUnknowns>(at)});
  }
  return groups;
}

TEST(Elimination, StepsAsTheDenseEquations) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Equations all = random_equations(seed);
    const VectorXd dense = all.information.ldlt().solve(all.gradient);
    const auto groups = groups_of<Eigen::Dynamic>(all);
    MatrixXd information = all.information.topLeftCorner<kSharedUnknowns, kSharedUnknowns>();
    VectorXd gradient = all.gradient.head<kSharedUnknowns>();
    for (const auto& group : groups) {
      information -= group.lost_information();
      gradient -= group.lost_gradient();
    }
    const VectorXd shared = information.ldlt().solve(gradient);
    EXPECT_LT((shared - dense.head<kSharedUnknowns>()).norm(), kRoundingOfGroups);
    for (int i = 0; i < kGroups; ++i)
      EXPECT_LT((groups[static_cast<std::size_t>(i)].step(shared) -
                 dense.segment<kOwnUnknowns>(kSharedUnknowns + i * kOwnUnknowns))
                    .norm(),
                kRoundingOfGroups);
  }
}

TEST(Elimination, GivesTheCovariancesAndTheDeterminantOfTheDenseEquations) {
  const Equations all = random_equations(21);
  const MatrixXd dense = all.information.inverse();
  const auto groups = groups_of<kSharedUnknowns>(all);
  Eigen::Matrix<double, kSharedUnknowns, kSharedUnknowns> information =
      all.information.topLeftCorner<kSharedUnknowns, kSharedUnknowns>();
  double log_determinant = 0;
  for (const auto& group : groups) {
    information -= group.lost_information();
    log_determinant += group.own().log_determinant;
  }
  const Inverted<kSharedUnknowns> shared(information);
  EXPECT_LT((shared.inverse - dense.topLeftCorner<kSharedUnknowns, kSharedUnknowns>()).norm(),
            kRoundingOfGroups);
  const auto& first = groups.front();
  const MatrixXd own = first.own().inverse + first.weighted().transpose() * shared.inverse * first.weighted();
  EXPECT_LT((own - dense.block<kOwnUnknowns, kOwnUnknowns>(kSharedUnknowns, kSharedUnknowns)).norm(),
            kRoundingOfGroups);
  EXPECT_NEAR(log_determinant + shared.log_determinant, std::log(all.information.determinant()), 1e-9);
}

}  // namespace
}  // namespace astro
