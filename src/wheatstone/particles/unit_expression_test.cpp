#include "wheatstone/particles/unit_expression.h"

#include <gtest/gtest.h>

namespace wheatstone {

TEST(UnitExpression, IsTheNameThatPeopleCallAUnitBy) {
  EXPECT_EQ(unit_expression("3.08568e+21 cm (kpc)"), "kpc");
  EXPECT_EQ(unit_expression("1.989e+43 g (1e10 Msun)"), "1e+10*Msun");
  EXPECT_EQ(unit_expression("3e+20 cm"), "3e+20*cm");
  EXPECT_EQ(unit_expression("code length"), "code_length");
  EXPECT_EQ(unit_expression("Msun"), "Msun");
  EXPECT_EQ(unit_expression(""), "");
}

TEST(UnitExpression, WritesPowersAndProductsWithSigns) {
  EXPECT_EQ(unit_expression("6.8e-31 g cm^-3"), "6.8e-31*g*cm**-3");
  EXPECT_EQ(unit_expression("km s-1"), "km*s**-1");
  EXPECT_EQ(unit_expression("km/s"), "km/s");
  EXPECT_EQ(unit_expression("1.00e+10 Msol"), "1e+10*Msun");
  EXPECT_EQ(unit_expression("Msun/(kpc)**2"), "Msun/(kpc)**2");
}

TEST(UnitExpression, LeavesCosmologicalFactorsAndOtherWords) {
  EXPECT_EQ(unit_expression("6.8e-31 g cm^-3 a^-3 h^2"), "6.8e-31 g cm^-3 a^-3 h^2");
  EXPECT_EQ(unit_expression("so many (of 10, say)"), "so many (of 10, say)");
}

TEST(UnitExpression, OfAColumnDensityHasOneNumber) {
  EXPECT_EQ(column_unit("1.989e+43 g (1e10 Msun)", "3.08568e+21 cm (kpc)"), "1e+10*Msun/kpc**2");
  EXPECT_EQ(column_unit("2e+40 g", "2e+20 cm"), "0.5*g/cm**2");
  EXPECT_EQ(column_unit("Msun", "kpc/h"), "Msun/(kpc/h)**2");
  EXPECT_EQ(column_unit("1", "kpc"), "1/kpc**2");
  EXPECT_EQ(column_unit("Msun", ""), "");
}

}  // namespace wheatstone
