#include "FaceCheck.h"

#include <QApplication>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/CaseTransfer.h"

namespace petrous::workstation
{

std::vector<std::string> facesIn(const scene::Case& value)
{
  std::vector<std::string> faces;
  QApplication::setOverrideCursor(Qt::WaitCursor);
  try
  {
    faces = presenters::facesToMask(value);
  }
  catch (const core::Error&)
  {
    faces.clear();
  }
  QApplication::restoreOverrideCursor();
  return faces;
}

} // namespace petrous::workstation
