#include "SlicesPanel.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "AskName.h"
#include "FittedBox.h"
#include "SliceColumn.h"
#include "SliceController.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{

using presenters::GreyWindow;
using presenters::Projection;
using presenters::Slab;
using Kind = presenters::SlicePlanes::Kind;
using scene::Side;

constexpr double kThickest = 100.0; // mm
constexpr std::size_t kLongestName = 60;

} // namespace

QString windowName(const std::string& name)
{
  return name == "Bone"            ? SlicesPanel::tr("Bone")
         : name == "Temporal bone" ? SlicesPanel::tr("Temporal bone")
         : name == "Soft tissue"   ? SlicesPanel::tr("Soft tissue")
         : name == "All tissue"    ? SlicesPanel::tr("All tissue")
         : name == "Dark half"     ? SlicesPanel::tr("Dark half")
                                   : words(name);
}

SlicesPanel::SlicesPanel(presenters::WorkstationModel& model, SliceColumn& slices,
                         SliceController& controller, WindowSettings& kept, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_slices(slices)
  , m_controller(controller)
  , m_kept(kept)
{
  auto* form = new QFormLayout(this);
  form->setContentsMargins(10, 10, 10, 10);
  addPlanes(form);
  addWindow(form);
  addSlab(form);
  addZoom(form);
}

void SlicesPanel::addPlanes(QFormLayout* form)
{
  auto* planes =
      choiceBox("slicePlanes", tr("Where the three slices lie. Ctrl+drag in a slice turns "
                                  "the other two about the crosshair"));
  planes->addItem(tr("Axial, coronal, sagittal"));
  planes->addItem(tr("Pöschl and Stenvers, left ear"));
  planes->addItem(tr("Pöschl and Stenvers, right ear"));
  planes->addItem(tr("Along the tool"));
  planes->addItem(tr("Turned by hand"));
  const auto row = [this]
  {
    switch (m_slices.planes().kind())
    {
    case Kind::Standard:
      return 0;
    case Kind::Petrous: // left: the coronal slice's right edge goes to the back
      return m_slices.planes().axes(presenters::SliceOrientation::Coronal).right.y() > 0.0 ? 1 : 2;
    case Kind::Tool:
      return 3;
    case Kind::Free:
      break;
    }
    return 4;
  };
  const auto set = [this](int chosen)
  {
    constexpr std::pair<Kind, Side> kRows[] = {{Kind::Standard, Side::Unknown},
                                               {Kind::Petrous, Side::Left},
                                               {Kind::Petrous, Side::Right},
                                               {Kind::Tool, Side::Unknown},
                                               {Kind::Free, Side::Unknown}};
    m_controller.setPlanes(kRows[chosen].first, kRows[chosen].second);
  };
  form->addRow(tr("&Planes"), m_bound.add(planes, row, set));
}

void SlicesPanel::addWindow(QFormLayout* form)
{
  m_windows = new FittedBox;
  m_windows->setObjectName("greyWindow");
  m_windows->setToolTip(tr("Grey windows by name: those of the image that is seen, and your own"));
  m_bound.add(
      m_windows,
      [this]
      {
        const GreyWindow& now = m_slices.seenWindow();
        const auto found =
            std::find_if(m_offered.begin(), m_offered.end(),
                         [&now](const presenters::NamedWindow& one) {
                           return one.window.width == now.width && one.window.level == now.level;
                         });
        return found == m_offered.end() ? -1 : static_cast<int>(found - m_offered.begin());
      },
      [this](int row)
      {
        if (row >= 0 && row < static_cast<int>(m_offered.size()))
          m_slices.setSeenWindow(m_offered[static_cast<std::size_t>(row)].window);
      });
  auto* line = new QHBoxLayout;
  line->addWidget(m_windows, 1);
  m_keep = button(tr("Keep…"), "keepWindow", tr("Keeps width and level under a name of yours"));
  connect(static_cast<QPushButton*>(m_keep), &QPushButton::clicked, this, &SlicesPanel::keepWindow);
  line->addWidget(m_keep);
  m_forget = button(tr("Remove"), "forgetWindow", tr("Takes your own window out of the list"));
  connect(static_cast<QPushButton*>(m_forget), &QPushButton::clicked, this,
          &SlicesPanel::forgetWindow);
  line->addWidget(m_forget);
  form->addRow(tr("&Grey window"), line);
  static_cast<QLabel*>(form->labelForField(line))->setBuddy(m_windows);

  m_width =
      numberBox("windowWidth", tr("From black to white; right drag in a slice changes it too"),
                {0.0, 1e6, {}, 0});
  m_level =
      numberBox("windowLevel", tr("In the middle between black and white"), {-1e6, 1e6, {}, 0});
  form->addRow(tr("&Width"), m_bound.add(
                                 m_width, [this] { return m_slices.seenWindow().width; },
                                 [this](double width)
                                 {
                                   if (width > 0.0)
                                     m_slices.setSeenWindow({width, m_slices.seenWindow().level});
                                 }));
  form->addRow(tr("&Level"), m_bound.add(
                                 m_level, [this] { return m_slices.seenWindow().level; },
                                 [this](double level) {
                                   m_slices.setSeenWindow({m_slices.seenWindow().width, level});
                                 }));
}

void SlicesPanel::addSlab(QFormLayout* form)
{
  auto* slab = choiceBox("slab", tr("What a slice shows of the layer about it (Ctrl+J)"));
  slab->addItem(tr("Thin slice"));
  slab->addItem(tr("Brightest (MIP)"));
  slab->addItem(tr("Darkest (MinIP)"));
  slab->addItem(tr("Mean"));
  auto* thickness = numberBox(
      "slabThickness",
      tr("Of the layer, mm (Shift+J thicker, Ctrl+Shift+J thinner; or Ctrl+] and Ctrl+[)"),
      {0.0, kThickest, tr(" mm"), 1, 1.0, tr("none")});
  const auto usual = [this]
  {
    Slab next = m_controller.slab();
    if (!(next.thickness > 0.0))
      next.thickness = 5.0;
    return next;
  };
  form->addRow(tr("&Slab"), m_bound.add(
                                slab,
                                [this]
                                {
                                  const Slab& now = m_controller.slab();
                                  return now.thickness > 0.0 ? static_cast<int>(now.projection) + 1
                                                             : 0;
                                },
                                [this, usual](int row)
                                {
                                  Slab next = usual();
                                  if (row > 0)
                                    next.projection = static_cast<Projection>(row - 1);
                                  else
                                    next.thickness = 0.0;
                                  m_controller.setSlab(next);
                                }));
  form->addRow(tr("&Thickness"), m_bound.add(
                                     thickness, [this] { return m_controller.slab().thickness; },
                                     [this](double mm)
                                     {
                                       Slab next = m_controller.slab();
                                       next.thickness = mm;
                                       m_controller.setSlab(next);
                                     }));
}

void SlicesPanel::addZoom(QFormLayout* form)
{
  form->addRow(m_bound.add(
      checkBox(tr("&Zoom slices together"), "zoomTogether",
               tr("A slice that is zoomed (Ctrl+wheel, + and -) takes the "
                  "others along, to one scale")),
      [this] { return m_controller.isZoomTogether(); },
      [this](bool on) { m_controller.setZoomTogether(on); }));
  form->addRow(m_bound.add(
      checkBox(tr("Zoom with the &3D view"), "zoomWithScene",
               tr("The slices have the scale that the 3D view has where it "
                  "turns about")),
      [this] { return m_controller.isZoomWithScene(); },
      [this](bool on) { m_controller.setZoomWithScene(on); }));
}

QString SlicesPanel::windowKind() const
{
  return m_slices.seesMr() ? "mr" : m_slices.seenDisplay().hounsfield ? "hounsfield" : "other";
}

void SlicesPanel::fillWindows()
{
  m_offered = m_slices.seenWindows();
  m_own = static_cast<int>(m_offered.size());
  for (presenters::NamedWindow& one : m_kept.greyWindows(windowKind()))
    m_offered.push_back(std::move(one));
  m_windows->clear();
  for (std::size_t n = 0; n < m_offered.size(); ++n)
    m_windows->addItem(static_cast<int>(n) < m_own ? windowName(m_offered[n].name)
                                                   : words(m_offered[n].name));
  m_windows->fit(m_own); // names of the user's may be long
  const presenters::IntensityDisplay display = m_slices.seenDisplay();
  for (QDoubleSpinBox* box : {m_width, m_level})
  {
    box->setDecimals(display.decimals);
    box->setSuffix(words(display.suffix()));
    box->setSingleStep(10.0 * display.unit);
  }
}

void SlicesPanel::refresh()
{
  if (!m_windows || !m_model.hasCase())
    return;
  m_bound.quietly([this] { fillWindows(); });
  m_bound.refresh();
  m_forget->setEnabled(m_windows->currentIndex() >= m_own);
}

void SlicesPanel::caseChanged()
{
  m_bound.drop();
  refresh();
}

void SlicesPanel::keepWindow()
{
  const GreyWindow now = m_slices.seenWindow();
  const auto display = m_slices.seenDisplay();
  const QString name = askName(
      *window(), tr("Keep the grey window"),
      tr("Name of the window of width %1 and level %2:")
          .arg(numberText(display.number(now.width)), numberText(display.number(now.level))),
      {},
      [](const std::string& text)
      {
        if (text.empty() || text.size() > kLongestName)
          throw core::InvalidParameter("A name has 1 to 60 bytes.");
      });
  if (name.isEmpty())
    return;
  m_kept.keepGreyWindow(windowKind(), {bytes(name), now});
  refresh();
}

void SlicesPanel::forgetWindow()
{
  const int row = m_windows->currentIndex();
  if (row < m_own || row >= static_cast<int>(m_offered.size()))
    return;
  m_kept.forgetGreyWindow(windowKind(), m_offered[static_cast<std::size_t>(row)].name);
  refresh();
}

} // namespace petrous::workstation
