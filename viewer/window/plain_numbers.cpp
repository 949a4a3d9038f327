#include "plain_numbers.h"

#include <QLocale>
#include <clocale>

namespace wheatstone::viewer {

void use_plain_numbers() {
  QLocale::setDefault(QLocale::c());
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace wheatstone::viewer
