#include "PanelButton.h"

#include <QPushButton>

namespace petrous::workstation
{

QPushButton* button(const QString& text, const char* name, const QString& tip)
{
  auto* result = new QPushButton(text);
  result->setObjectName(name);
  result->setToolTip(tip);
  return result;
}

} // namespace petrous::workstation
