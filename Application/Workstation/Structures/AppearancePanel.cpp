#include "AppearancePanel.h"

#include <QApplication>
#include <QClipboard>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>

#include "Application.h"
#include "AskName.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "TransferPlot.h"
#include "WindowTexts.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

using appearance::ControlPoint;
using presenters::AppearanceEditor;

namespace
{

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 20; // bytes, as of the command
constexpr int kMargin = 10;                                      // px
constexpr double kFarthest = 1e7;                                // value that can be entered
constexpr int kSwatch = 14;                                      // px

QColor toColor(const std::array<float, 3>& color)
{
  return QColor::fromRgbF(double(color[0]), double(color[1]), double(color[2]));
}

QToolButton* menuButton(const QString& text, const char* name, const QString& tip, QMenu* menu)
{
  auto* result = new QToolButton;
  result->setText(text);
  result->setObjectName(name);
  result->setToolTip(tip);
  result->setMenu(menu);
  result->setPopupMode(QToolButton::InstantPopup);
  result->setFocusPolicy(Qt::StrongFocus);
  menu->setParent(result, menu->windowFlags());
  return result;
}

} // namespace

AppearancePanel::AppearancePanel(presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_editor(model)
  , m_plot(new TransferPlot(m_editor))
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(kMargin, kMargin, kMargin, kMargin);
  layout->setSpacing(8);
  addChoices(*layout);
  layout->addWidget(m_plot, 1);
  addPointRow(*layout);
  addSurfaceRow(*layout);
  m_note = new QLabel;
  m_note->setObjectName("appearanceNote");
  m_note->setTextFormat(Qt::PlainText);
  wrapWords(*m_note);
  layout->addWidget(m_note);
  setMinimumWidth(340);

  connect(m_plot, &TransferPlot::changed, this,
          [this]
          {
            m_fault.clear();
            showEditor();
          });
  connect(m_plot, &TransferPlot::colorAsked, this, &AppearancePanel::chooseColor);
  connect(m_plot, &TransferPlot::copyAsked, this, &AppearancePanel::copy);
  connect(m_plot, &TransferPlot::pasteAsked, this, &AppearancePanel::paste);
  const auto ended = [this]
  {
    m_editor.notCounted();
    showEditor();
  };
  connect(&m_work, &BackgroundWork::failed, this, ended);
  connect(&m_work, &BackgroundWork::cancelled, this,
          [this, ended]
          {
            ended();
            count(); // the panel may have been opened again
          });
  showEditor();
}

void AppearancePanel::addChoices(QBoxLayout& layout)
{
  m_part = choiceBox("appearancePart", tr("Whose transfer function is edited; a click on a curve "
                                          "chooses it too"));
  m_part->setAccessibleName(tr("Structure"));
  m_part->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  m_part->setMinimumContentsLength(12);
  m_bound.add(
      m_part,
      [this]
      { return m_editor.selected() ? m_part->findData(words(m_editor.selected()->name)) : -1; },
      [this](int row)
      {
        m_editor.select(bytes(m_part->itemData(row).toString()));
        m_fault.clear();
        showEditor();
      });
  m_source = choiceBox("appearanceSource", tr("The image whose intensities are read"));
  m_source->setAccessibleName(tr("Image"));
  m_source->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  m_source->setMinimumContentsLength(4);
  m_bound.add(
      m_source,
      [this]
      {
        const auto* part = m_editor.selected();
        return part && part->look.solid ? m_source->findData(words(part->look.sourceImage)) : 0;
      },
      [this](int row)
      { attempt([&] { m_editor.setSource(bytes(m_source->itemData(row).toString())); }); });

  auto* presets = new QMenu;
  presets->setObjectName("presetMenu");
  connect(presets, &QMenu::aboutToShow, this, [this, presets] { fillPresets(*presets); });
  auto* function = new QMenu;
  function->setObjectName("functionMenu");
  connect(function, &QMenu::aboutToShow, this, [this, function] { fillFunction(*function); });
  auto* reads = new QLabel(tr("rea&ds"));
  reads->setBuddy(m_source);
  auto* top = new QHBoxLayout;
  top->addWidget(m_part, 3);
  top->addWidget(reads);
  top->addWidget(m_source, 2);
  auto* below = new QHBoxLayout;
  below->addWidget(menuButton(tr("&Preset"), "presetButton",
                              tr("Presets of the program and of this library"), presets));
  below->addWidget(
      menuButton(tr("F&unction"), "functionButton", tr("Copy, paste, files, reset"), function));
  below->addStretch();
  layout.addLayout(top);
  layout.addLayout(below);
}

void AppearancePanel::addPointRow(QBoxLayout& layout)
{
  m_pointName = new QLabel;
  m_pointName->setObjectName("pointName");
  wrapWords(*m_pointName);
  m_add = button(tr("&Add"), "addPoint", tr("A point halfway to the next one (Ins in the plot)"));
  m_remove = button(tr("&Remove"), "removePoint",
                    tr("Removes the selected point (Del in the "
                       "plot)"));
  m_color = button({}, "pointColor",
                   tr("Colour of the selected point; without one, of the whole "
                      "structure, whose points keep their shades"));
  m_color->setAccessibleName(tr("Colour"));
  m_color->setStyleSheet("QPushButton { padding: 6px; }");
  const auto pointOr = [this](double otherwise, auto get)
  {
    return m_editor.selected() && m_editor.point()
               ? double(get(m_editor.selected()->points[*m_editor.point()]))
               : otherwise;
  };
  const auto change = [this](auto set)
  {
    return [this, set](double number)
    {
      if (!m_editor.point())
        return;
      ControlPoint point = m_editor.selected()->points[*m_editor.point()];
      set(point, number);
      attempt([&] { m_editor.setPoint(point); });
    };
  };
  m_value = numberBox("pointValue", tr("Intensity of the point, in the image's unit"),
                      {-kFarthest, kFarthest, {}, 0, 10.0});
  m_value->setAccessibleName(tr("Intensity"));
  m_bound.add(
      m_value, [=] { return pointOr(0.0, [](const ControlPoint& p) { return p.value; }); },
      change([](ControlPoint& p, double number) { p.value = number; }));
  m_opacity = numberBox("pointOpacity", tr("Opacity of 1 mm of this tissue, 0 to 1"),
                        {0.0, 1.0, {}, 4, 0.01});
  m_opacity->setAccessibleName(tr("Opacity of 1 mm"));
  m_bound.add(
      m_opacity, [=] { return pointOr(0.0, [](const ControlPoint& p) { return p.opacity; }); },
      change([](ControlPoint& p, double number) { p.opacity = static_cast<float>(number); }));
  m_specular = numberBox("pointSpecular",
                         tr("Strength of the highlight on a surface there, 0 to "
                            "1"),
                         {0.0, 1.0, {}, 2, 0.05});
  m_specular->setAccessibleName(tr("Specular"));
  m_bound.add(
      m_specular, [=] { return pointOr(0.0, [](const ControlPoint& p) { return p.specular; }); },
      change([](ControlPoint& p, double number) { p.specular = static_cast<float>(number); }));
  connect(m_add, &QPushButton::clicked, this,
          [this] { attempt([this] { m_editor.addPointAfterSelected(); }); });
  connect(m_remove, &QPushButton::clicked, this,
          [this] { attempt([this] { m_editor.removePoint(); }); });
  connect(m_color, &QPushButton::clicked, this, &AppearancePanel::chooseColor);

  auto* head = new QHBoxLayout;
  head->addWidget(m_pointName, 1);
  head->addWidget(m_add);
  head->addWidget(m_remove);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(8);
  const auto add = [grid](const QString& text, QWidget* widget, int row, int column)
  {
    auto* label = new QLabel(text);
    label->setBuddy(widget);
    wrapWords(*label); // large letters
    grid->addWidget(label, row, 2 * column);
    grid->addWidget(widget, row, 2 * column + 1);
    grid->setColumnStretch(2 * column + 1, 1);
  };
  add(tr("&Intensity"), m_value, 0, 0);
  add(tr("&Colour"), m_color, 0, 1);
  add(tr("&Opacity of 1 mm"), m_opacity, 1, 0);
  add(tr("&Specular"), m_specular, 1, 1);
  layout.addLayout(head);
  layout.addLayout(grid);
}

void AppearancePanel::addSurfaceRow(QBoxLayout& layout)
{
  m_surface = m_bound.add(
      percentSlider("surfaceOpacity", tr("Of the surface. Below 100 % the inside is seen, with the "
                                         "opacities of the points")),
      [this]
      { return m_editor.selected() ? percent(double(m_editor.selected()->look.opacity)) : 100; },
      [this](int percent) { attempt([&] { m_editor.setSurfaceOpacity(0.01 * percent); }); },
      Bindings::kSettle);
  m_surface->setAccessibleName(tr("Opacity of the surface"));
  auto* number = new QLabel;
  number->setMinimumWidth(fontMetrics().horizontalAdvance("100 %"));
  number->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  const auto tell = [number](int percent) { number->setText(tr("%1 %").arg(percent)); };
  tell(m_surface->value());
  connect(m_surface, &QSlider::valueChanged, number, tell);
  m_surfaceLabel = new QLabel(tr("Sur&face"));
  m_surfaceLabel->setBuddy(m_surface);
  auto* row = new QHBoxLayout;
  row->addWidget(m_surfaceLabel);
  row->addWidget(m_surface, 1);
  row->addWidget(number);
  layout.addLayout(row);
}

void AppearancePanel::caseChanged()
{
  m_bound.drop();
  m_fault.clear();
  m_work.cancel(); // it was of another case
  refresh();
}

void AppearancePanel::appearanceChanged()
{
  if (isVisible())
    refresh();
}

void AppearancePanel::partRenamed(const std::string& from, const std::string& to)
{
  m_editor.renamed(from, to);
  if (m_followed.second == from)
    m_followed.second = to;
  if (m_wanted == from)
    m_wanted = to;
}

void AppearancePanel::follow(const std::vector<std::string>& parts)
{
  if (parts.size() != 1)
    return;
  std::pair followed(m_model.shownAs(), parts.front());
  if (followed == m_followed) // the list is filled anew at times
    return;
  m_followed = std::move(followed);
  m_wanted = parts.front();
  if (isVisible())
    refresh();
}

void AppearancePanel::showEvent(QShowEvent* event)
{
  Panel::showEvent(event);
  refresh();
}

void AppearancePanel::hideEvent(QHideEvent* event)
{
  Panel::hideEvent(event);
  m_work.cancel();
}

void AppearancePanel::refresh()
{
  m_editor.refresh();
  if (const auto part = std::exchange(m_wanted, std::nullopt))
  {
    m_fault.clear();
    m_editor.select(*part);
  }
  showEditor();
  count();
}

void AppearancePanel::showEditor()
{
  showParts();
  showSources();
  showPoint();
  m_bound.refresh();
  showNote();
  m_plot->refresh();
}

void AppearancePanel::showParts()
{
  const auto& parts = m_editor.parts();
  const bool isOnMr = m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
  m_bound.quietly(
      [&]
      {
        while (m_part->count() > static_cast<int>(parts.size()))
          m_part->removeItem(m_part->count() - 1);
        for (int row = 0; row < static_cast<int>(parts.size()); ++row)
        {
          const AppearanceEditor::Part& part = parts[static_cast<std::size_t>(row)];
          const QString name = part.name == AppearanceEditor::kSoftTissue ? tr("Soft tissue")
                               : part.name != AppearanceEditor::kBone     ? shownName(part.name)
                               : isOnMr                                   ? tr("Tissue")
                                                                          : tr("Bone");
          if (row >= m_part->count())
            m_part->addItem(name);
          m_part->setItemText(row, name);
          m_part->setItemData(row, words(part.name));
          const QColor color = toColor(part.look.color);
          if (m_part->itemData(row, Qt::UserRole + 1).value<QColor>() != color)
          {
            m_part->setItemData(row, color, Qt::UserRole + 1);
            m_part->setItemIcon(row, swatch(color, kSwatch));
          }
        }
      });
  setEnabled(!parts.empty());
}

void AppearancePanel::showSources()
{
  const auto sources = m_editor.sources();
  QStringList names, there;
  for (const auto& source : sources)
    names += source.name.empty() ? QString(presenters::primaryName(m_model.value()))
             : source.registered ? words(source.name)
                                 : tr("%1 (not registered)").arg(words(source.name));
  for (int row = 0; row < m_source->count(); ++row)
    there += m_source->itemText(row);
  if (names != there)
    m_bound.quietly(
        [&]
        {
          m_source->clear();
          for (int row = 0; row < names.size(); ++row)
            m_source->addItem(names[row], words(sources[static_cast<std::size_t>(row)].name));
        });
  const std::string fixed = m_editor.sourceFixed();
  m_source->setEnabled(sources.size() > 1 && fixed.empty());
  m_source->setToolTip(!fixed.empty()       ? phrase(fixed)
                       : sources.size() > 1 ? tr("The image whose intensities are read")
                                            : tr("The image whose intensities are read; the case "
                                                 "has no MR beside it"));
}

void AppearancePanel::showPoint()
{
  const AppearanceEditor::Part* part = m_editor.selected();
  const auto point = m_editor.point();
  const bool isDrilling = m_model.drilling();
  for (QWidget* widget : {static_cast<QWidget*>(m_value), static_cast<QWidget*>(m_opacity),
                          static_cast<QWidget*>(m_specular), static_cast<QWidget*>(m_remove)})
    widget->setEnabled(point && !isDrilling);
  m_add->setEnabled(part && !isDrilling);
  m_color->setEnabled(part && !isDrilling);
  m_surface->setEnabled(part && !isDrilling);
  const bool hasSurface = !part || part->name != AppearanceEditor::kSoftTissue;
  m_surfaceLabel->setText(hasSurface ? tr("Sur&face") : tr("O&pacity"));
  m_surface->setAccessibleName(hasSurface ? tr("Opacity of the surface") : tr("Opacity"));
  m_surface->setToolTip(hasSurface ? tr("Of the surface. Below 100 % the inside is seen, with the "
                                        "opacities of the points")
                                   : tr("Factor of the opacities of all points"));
  m_pointName->setText(!part   ? QString()
                       : point ? tr("Point %1 of %2").arg(*point + 1).arg(part->points.size())
                       : part->points.empty() ? tr("One colour at every intensity")
                       : part->points.size() == 1
                           ? tr("1 point, not selected")
                           : tr("%1 points, none selected").arg(part->points.size()));
  const AppearanceEditor::Axis axis = m_editor.axis();
  m_bound.quietly(
      [&]
      {
        m_value->setDecimals(axis.decimals);
        m_value->setSingleStep(axis.step);
        m_value->setSuffix(axis.unit.empty() ? QString() : ' ' + words(axis.unit));
        m_value->setSpecialValueText({});
      });
  if (!part)
    return;
  const QColor color = toColor(m_editor.color());
  m_color->setIcon(swatch(color, kSwatch));
  m_color->setText(color.name());
}

void AppearancePanel::showNote()
{
  const AppearanceEditor::Part* part = m_editor.selected();
  QString text = m_fault;
  if (text.isEmpty() && part)
  {
    if (const std::string notice = m_editor.notice(); !notice.empty())
      text =
          phrase(notice) +
          (m_editor.canFit() ? tr(". Function > Fit to the histogram sets some.") : QString('.'));
    else if (part->name == AppearanceEditor::kSoftTissue)
      text = tr("It has no surface: colours and opacities of the points are seen, these times the "
                "opacity of the whole. Below its first point it is transparent, as air must be.") +
             (m_editor.estimate().empty() ? QString()
                                          : QChar(' ') + phrase(m_editor.estimate()) + QChar('.'));
    else if (!part->look.solid)
      text = tr("A space without tissue tints the bone around it: its colours count, its opacities "
                "do not.");
    else if (part->look.opacity >= 1.0F)
      text =
          tr("The surface is opaque, so the opacities of this curve do not show, only its colours "
             "and highlights; lower the opacity of the surface to look inside.");
  }
  m_note->setText(text);
  m_note->setVisible(!text.isEmpty());
}

// In the background, while the panel is open.
void AppearancePanel::count()
{
  if (!isVisible() || m_work.busy())
    return;
  auto counting = m_editor.beginCounting();
  if (!counting)
    return;
  m_work.start(
      [this, counting = std::move(counting),
       of = m_model.shownAs()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        return [this, of, done = counting(progress)]
        {
          m_editor.counted(done, of);
          showEditor();
          count(); // another image was chosen meanwhile
        };
      });
}

void AppearancePanel::attempt(const std::function<void()>& action)
{
  m_fault.clear();
  guarded(action, [this](const QString& why) { m_fault = sentence(why); });
  showEditor();
  count();
}

namespace
{
// Of Resources/structures.json, for the translation.
[[maybe_unused]] constexpr const char* kPresets[] = {
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "cholesteatoma"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "tumour"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "ossicle"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "air-cells"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "ear-canal"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "vein"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "artery"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "nerve"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "inner-ear"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "dura"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "muscle"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "bone"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "bone-translucent"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "soft-tissue"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "skin"),
    QT_TRANSLATE_NOOP("petrous::workstation::AppearancePanel", "other"),
};
} // namespace

void AppearancePanel::fillPresets(QMenu& menu)
{
  menu.clear();
  qDeleteAll(menu.findChildren<QMenu*>());
  std::vector<AppearanceEditor::Preset> presets;
  attempt([&] { presets = m_editor.presets(); });
  const std::string present = m_editor.selected() ? m_editor.selected()->look.preset : "";
  bool wasOwn = false;
  auto* remove = new QMenu(tr("&Delete"), &menu);
  for (const AppearanceEditor::Preset& preset : presets)
  {
    if (preset.isOwn && !wasOwn)
      menu.addSection(tr("Of this library"));
    wasOwn = preset.isOwn;
    const QString name = words(preset.look.preset);
    const QString shown =
        QString(preset.isOwn ? name : tr(preset.look.preset.c_str())).replace('&', "&&");
    if (preset.isOwn)
      connect(remove->addAction(shown), &QAction::triggered, this,
              [this, name] { attempt([&] { m_editor.deletePreset(bytes(name)); }); });
    if (!m_editor.canHave(preset))
      continue;
    QAction* action = menu.addAction(swatch(toColor(preset.look.color), kSwatch), shown);
    action->setCheckable(true);
    action->setChecked(preset.look.preset == present);
    connect(action, &QAction::triggered, this,
            [this, name] { attempt([&] { m_editor.applyPreset(bytes(name)); }); });
  }
  menu.addSeparator();
  QAction* save = menu.addAction(tr("&Save as a preset…"), this, &AppearancePanel::savePreset);
  save->setObjectName("savePreset");
  save->setEnabled(m_editor.selected() != nullptr);
  if (wasOwn)
    menu.addMenu(remove);
}

void AppearancePanel::fillFunction(QMenu& menu)
{
  menu.clear();
  const bool isThere = m_editor.selected() != nullptr;
  const auto add = [&](const QString& text, const char* name, auto what, bool isEnabled = true)
  {
    QAction* action = menu.addAction(text, this, what);
    action->setObjectName(name);
    action->setEnabled(isThere && isEnabled);
    return action;
  };
  add(tr("&Copy"), "copyFunction", [this] { copy(); });
  add(tr("&Paste"), "pasteFunction", [this] { paste(); });
  menu.addSeparator();
  add(tr("&Import…"), "importFunction", [this] { importFile(); });
  add(tr("&Export…"), "exportFunction", [this] { exportFile(); });
  menu.addSeparator();
  add(
      tr("&Fit to the histogram"), "fitFunction", [this] { attempt([this] { m_editor.fit(); }); },
      m_editor.canFit());
  add(
      tr("&One colour"), "clearFunction", [this] { attempt([this] { m_editor.clearPoints(); }); },
      isThere && !m_editor.selected()->points.empty());
  add(tr("&Reset to the preset “%1”")
          .arg(isThere ? words(m_editor.selected()->look.preset).replace('&', "&&") : QString()),
      "resetFunction", [this] { attempt([this] { m_editor.reset(); }); });
  menu.addSeparator();
  add(tr("Show the &whole axis"), "wholeAxis", [this] { m_plot->showAll(); });
}

// The picture follows while a colour is looked for; Cancel brings back the one before.
void AppearancePanel::chooseColor()
{
  if (!m_editor.selected() || m_model.drilling())
    return;
  const QColor before = toColor(m_editor.color());
  QColorDialog dialog(before, this);
  dialog.setObjectName("colorDialog");
  dialog.setOption(QColorDialog::DontUseNativeDialog);
  // What is tried is one step, and none if nothing is chosen.
  const presenters::EditHistory::Hold hold(m_model.edits());
  const auto last = m_model.edits().last();
  const auto of = m_model.shownAs();
  const auto takeBack = [&] { attempt([&] { m_model.takeBackTried(last, of); }); };
  const auto paint = [&](const QColor& color)
  {
    if (!m_editor.point()) // a dark one in between would flatten the points' shades
      takeBack();
    setColor(color);
  };
  connect(&dialog, &QColorDialog::currentColorChanged, this, paint);
  if (dialog.exec() == QDialog::Accepted)
    paint(dialog.selectedColor());
  else
    takeBack();
}

void AppearancePanel::setColor(const QColor& color)
{
  attempt(
      [&]
      {
        m_editor.setColor({static_cast<float>(color.redF()), static_cast<float>(color.greenF()),
                           static_cast<float>(color.blueF())});
      });
}

void AppearancePanel::savePreset()
{
  const QString name = askName(
      *this, tr("Save as a preset"),
      tr("Name of the preset. It is kept in the library, for all of its cases, with colours, "
         "opacities, material and warning distance; a preset of that name is replaced."),
      {}, [](const std::string& typed) { appearance::OwnPresets::checkName(typed); });
  if (!name.isEmpty())
    attempt([&] { m_editor.savePreset(bytes(name)); });
}

// As the text of a file that `petrous appearance --tf` reads.
void AppearancePanel::copy()
{
  if (m_editor.selected())
    QApplication::clipboard()->setText(words(m_editor.json()));
}

void AppearancePanel::paste()
{
  attempt(
      [this]
      {
        const QString text = QApplication::clipboard()->text();
        if (text.trimmed().isEmpty())
          throw core::InvalidParameter("the clipboard holds no transfer function");
        m_editor.setJson(bytes(text));
      });
}

void AppearancePanel::importFile()
{
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Import a transfer function"), {}, tr("Transfer functions (*.json);;All files (*)"));
  if (!file.isEmpty())
    attempt([&] { m_editor.setJson(core::readFile(pathOf(file), kLargestFile)); });
}

void AppearancePanel::exportFile()
{
  QFileDialog dialog(this, tr("Export the transfer function"));
  dialog.setNameFilter(tr("Transfer functions (*.json)"));
  dialog.setDefaultSuffix("json");
  const std::filesystem::path file = askFile(dialog);
  if (file.empty())
    return;
  attempt(
      [&]
      {
        library::refuseOverwriting(file, m_model.library().folder());
        core::writeFile(file, m_editor.json() + "\n");
      });
}

} // namespace petrous::workstation
