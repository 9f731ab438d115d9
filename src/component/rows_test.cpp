// Rows of numbers: what Eigen's matrices are copied into, and out of.
#include "contact/rows.hpp"

#include <gtest/gtest.h>

#include "component/models_for_tests.hpp"

namespace contact {
namespace {

using component::what_of;

Eigen::MatrixXd counted(Index rows, Index cols) {
  Eigen::MatrixXd all(rows, cols);
  for (Index i = 0; i < rows; ++i)
    for (Index k = 0; k < cols; ++k) all(i, k) = static_cast<double>(10 * i + k);
  return all;
}

TEST(Rows, take_any_matrix_of_their_width) {
  const Eigen::MatrixXd m = counted(5, 3);
  const Rows<3> rows = m;
  EXPECT_EQ(rows.matrix(), m);
  EXPECT_EQ(rows.vector(4), Vector3(40, 41, 42));
  EXPECT_EQ(rows(2, 1), 21);
  EXPECT_EQ(Rows<3>(2 * m.topRows(2)).matrix(), 2 * m.topRows(2)) << "an expression";
  EXPECT_EQ(Rows<3>(Eigen::RowVector3d(1, 2, 3)).rows(), 1);
  EXPECT_EQ(Rows<3>(Eigen::Matrix<float, 2, 3>(Eigen::Matrix<float, 2, 3>::Ones()).cast<double>())(1, 2), 1);
  EXPECT_EQ((Rows<3>(Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>(m)).matrix()), m);
  EXPECT_EQ(Rows<Eigen::Dynamic>(m).cols(), 3);
  EXPECT_EQ(Rows<3>(Rows<Eigen::Dynamic>(m)).matrix(), m);
}

TEST(Rows, of_one_number_are_made_of_columns_and_of_rows) {
  EXPECT_EQ(Rows<1>(Eigen::Vector3d(1, 2, 3))(2), 3);
  const Rows<1> turned = Eigen::RowVectorXd(Eigen::RowVector4d(1, 2, 3, 4));
  EXPECT_EQ(turned.rows(), 4);
  EXPECT_EQ(turned(3), 4);
  EXPECT_EQ(Rows<1>(Eigen::VectorXd(0)).size(), 0);
}

TEST(Rows, refuse_another_width) {
  EXPECT_EQ(what_of<std::invalid_argument>([] { (void)Rows<3>(counted(5, 4)); }), "4 numbers a row where 3 are wanted");
  EXPECT_EQ(what_of<std::invalid_argument>([] { (void)Rows<1>(counted(2, 2)); }), "2 numbers a row where 1 are wanted");
  EXPECT_EQ(what_of<std::invalid_argument>([] { (void)Rows<4>(Rows<Eigen::Dynamic>(counted(2, 3))); }),
            "3 numbers a row where 4 are wanted");
  EXPECT_EQ(what_of<std::invalid_argument>([] {
              const Eigen::MatrixX3d three = Rows<Eigen::Dynamic>(counted(2, 2));
              (void)three;
            }),
            "2 numbers a row where 3 are wanted");
}

TEST(Rows, that_are_moved_from_hold_none) {
  Rows<3> first = counted(4, 3);
  Rows<3> second = std::move(first);
  EXPECT_EQ(first.rows(), 0);  // NOLINT(bugprone-use-after-move): what is left is asked
  EXPECT_EQ(first.cols(), 3);
  EXPECT_EQ(second.matrix(), counted(4, 3));
  first = std::move(second);
  EXPECT_EQ(second.rows(), 0);  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(first.matrix(), counted(4, 3));
  second = first;
  EXPECT_EQ(first.matrix(), second.matrix());
}

TEST(Rows, give_copies_and_maps_of_what_they_hold) {
  Rows<Eigen::Dynamic> rows = counted(4, 3);
  const Eigen::MatrixX3d copy = rows;
  rows(3, 2) = -1;
  EXPECT_EQ(copy, counted(4, 3));
  EXPECT_EQ(rows.matrix()(3, 2), -1);
  EXPECT_EQ(rows.matrix().data(), rows.data());
}

TEST(Rows, of_no_element_have_their_width_all_the_same) {
  EXPECT_EQ(Rows<3>().cols(), 3);
  EXPECT_EQ(Rows<3>(Eigen::MatrixX3d(0, 3)).rows(), 0);
  EXPECT_EQ(Rows<3>(Rows<Eigen::Dynamic>(Eigen::MatrixXd(0, 3))).cols(), 3);
}

}  // namespace
}  // namespace contact
