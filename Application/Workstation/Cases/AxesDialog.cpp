#include "AxesDialog.h"

#include <algorithm>
#include <memory>
#include <string>

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/Placement.h"

namespace petrous::workstation
{

namespace
{

using core::AxesCorrection;
using presenters::SliceOrientation;

constexpr char kLetters[] = {'L', 'R', 'P', 'A', 'S', 'I'};

QString directionText(char letter)
{
  switch (letter)
  {
  case 'L':
    return AxesDialog::tr("Left");
  case 'R':
    return AxesDialog::tr("Right");
  case 'P':
    return AxesDialog::tr("Back");
  case 'A':
    return AxesDialog::tr("Front");
  case 'S':
    return AxesDialog::tr("Head");
  default:
    return AxesDialog::tr("Feet");
  }
}

char opposite(char letter)
{
  const auto* at = std::find(std::begin(kLetters), std::end(kLetters), letter);
  return kLetters[(at - std::begin(kLetters)) ^ 1];
}

QString shownNames(const std::vector<std::string>& names)
{
  QStringList all;
  for (const std::string& name : names)
    all += shownName(name);
  return all.join(", ");
}

QString followText(const presenters::AxesFollowers& followers)
{
  QStringList lines;
  if (!followers.parts.empty())
    lines += AxesDialog::tr("Goes along: %1").arg(shownNames(followers.parts));
  if (!followers.unregistered.empty())
    lines +=
        AxesDialog::tr("Is to be registered again: %1").arg(shownNames(followers.unregistered));
  return lines.join('\n');
}

// The middle of what is corrected on the image, in its space.
Eigen::Vector3d middleOf(const scene::Case& image)
{
  if (!image.meshes.empty())
  {
    const auto bounds = image.meshes.front().mesh.get()->bounds();
    return 0.5 * (bounds[0] + bounds[1]).cast<double>();
  }
  if (!image.labels.empty())
  {
    const auto labels = image.labels.front().labels.get();
    const core::IndexBox box = volume::extentOf(*labels);
    Eigen::Vector3d middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
      middle[static_cast<Eigen::Index>(axis)] = 0.5 * (box.lower[axis] + box.upper[axis] - 1);
    return labels->voxels->geometry().patientFromVoxel(middle);
  }
  return image.ct.geometry.center();
}

QString leftText(const presenters::LeftBehind& left)
{
  QStringList lines;
  const auto add = [&lines](const QString& line)
  { lines += QString::fromUtf8("\xe2\x80\xa2 ") + line; };
  if (!left.mr.empty())
    add(AxesDialog::tr("MRs with their registrations: %1").arg(shownNames(left.mr)));
  if (!left.drawnOnMr.empty())
    add(AxesDialog::tr("Drawn on an MR: %1").arg(shownNames(left.drawnOnMr)));
  if (left.strokes > 0)
    add(AxesDialog::tr("Strokes: %1").arg(left.strokes));
  if (left.measurements > 0)
    add(AxesDialog::tr("Measurements: %1").arg(left.measurements));
  if (left.attachments > 0)
    add(AxesDialog::tr("Attachments: %1").arg(left.attachments));
  if (left.savedViews > 0)
    add(AxesDialog::tr("Saved views: %1").arg(left.savedViews));
  return lines.isEmpty() ? AxesDialog::tr("All of this case comes along.")
                         : AxesDialog::tr("Stays with this case alone:") + "\n" + lines.join('\n');
}

} // namespace

std::array<CommonCorrection, 3> commonCorrections()
{
  return {
      {{AxesDialog::tr("Exchange left and &right"),
        AxesDialog::tr("Of a mirrored image: the side of the operation is at stake"), "axesMirror",
        AxesCorrection::parse("RPS")},
       {AxesDialog::tr("Exchange head and &feet"),
        AxesDialog::tr("Of an image whose slices are in the wrong order, which mirrors it, too"),
        "axesHeadFeet", AxesCorrection::parse("LPI")},
       {AxesDialog::tr("&Turn front to back"),
        AxesDialog::tr("Half a turn about the long axis, as of a patient who lay face down: "
                       "front and back are exchanged, and left and right"),
        "axesTurn", AxesCorrection::parse("RAS")}}};
}

AxesDialog::AxesDialog(const scene::Case& value, QWidget* parent, std::string part)
  : QDialog(parent)
  , m_image(value)
  , m_views{new SliceView(SliceOrientation::Axial), new SliceView(SliceOrientation::Coronal),
            new SliceView(SliceOrientation::Sagittal)}
  , m_kind(new QLabel)
{
  setObjectName("correctAxes");
  setWindowTitle(tr("Correct the axes"));
  resizeOnScreen(*this, {900, 620});
  presenters::AxesFollowers followers;
  if (part.empty())
    showImage(value, {});
  else
  {
    const presenters::AxesPart corrected = presenters::axesPart(value, part);
    followers = presenters::axesFollowers(value, corrected);
    showOnly(value, corrected);
  }

  auto* title = new QLabel(
      part.empty()
          ? tr("For an image whose file states wrong axes: it is mirrored, or lies otherwise than "
               "the letters say. What is right becomes a new case; “%1” stays as it is. Which ear "
               "it is will be asked again.")
                .arg(words(value.name))
          : tr("For a file that states wrong axes: it is mirrored, or lies otherwise than the "
               "letters say. “%1” is corrected in this case; Ctrl+Z takes that back.")
                .arg(shownName(part)));
  title->setTextFormat(Qt::PlainText);
  wrapWords(*title);
  auto* form = new QFormLayout;
  const std::array<QString, 3> rows{tr("What is now &left is really:"),
                                    tr("What is now &back is really:"),
                                    tr("What is now &head is really:")};
  const std::array<const char*, 3> names{"axesLeft", "axesBack", "axesHead"};
  for (std::size_t axis = 0; axis < m_choices.size(); ++axis)
  {
    auto* choice = new QComboBox;
    choice->setObjectName(names[axis]);
    choice->setToolTip(tr("Where this side of the image really is. Another one that had this "
                          "direction takes the one that was here"));
    for (const char letter : kLetters)
      choice->addItem(directionText(letter), QChar(letter));
    connect(choice, qOverload<int>(&QComboBox::currentIndexChanged), this,
            [this, axis, choice] { choose(axis, choice->currentData().toChar().toLatin1()); });
    form->addRow(rows[axis], choice);
    m_choices[axis] = choice;
  }
  auto* quick = new QVBoxLayout;
  for (const CommonCorrection& common : commonCorrections())
  {
    auto* button = new QPushButton(common.text);
    button->setObjectName(common.name);
    button->setToolTip(common.tip);
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this,
            [this, axes = common.axes] { setAxes(axes * m_axes); });
    quick->addWidget(button);
  }
  auto* choices = new QHBoxLayout;
  choices->addLayout(form, 1);
  choices->addLayout(quick);

  auto* views = new QHBoxLayout;
  views->setSpacing(3);
  const auto display = presenters::displayOf(m_image);
  for (SliceView* view : m_views)
  {
    view->setAttribute(Qt::WA_TransparentForMouseEvents);
    view->setFocusPolicy(Qt::NoFocus);
    view->setMinimumHeight(180);
    view->setIntensityDisplay(display);
    view->setGreyWindow(display.bone);
    views->addWidget(view, 1);
  }
  m_kind->setObjectName("axesKind");
  wrapWords(*m_kind);
  auto* left =
      new QLabel(part.empty() ? leftText(presenters::leftBehind(value)) : followText(followers));
  left->setObjectName("axesLeftBehind");
  left->setTextFormat(Qt::PlainText);
  wrapWords(*left);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_apply =
      buttons->addButton(part.empty() ? tr("&Make the corrected case") : tr("C&orrect the axes"),
                         QDialogButtonBox::AcceptRole);
  m_apply->setObjectName("primary");
  if (part.empty())
    m_apply->setToolTip(tr("A new case in the library, which is opened"));
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addLayout(choices);
  layout->addLayout(views, 1);
  layout->addWidget(m_kind);
  layout->addWidget(left);
  layout->addWidget(buttons);
  setAxes({});
}

// Another one along the same axis takes the direction that was here.
void AxesDialog::choose(std::size_t axis, char letter)
{
  std::string letters = m_axes.letters();
  const char before = letters[axis];
  for (char& other : letters)
    if (&other != &letters[axis] && (other == letter || other == opposite(letter)))
      other = before;
  letters[axis] = letter;
  setAxes(AxesCorrection::parse(letters));
}

void AxesDialog::showOnly(const scene::Case& value, const presenters::AxesPart& part)
{
  using Kind = presenters::AxesPart::Kind;
  if (part.kind == Kind::Mr)
    return showImage(value, part.name);
  m_part = part;
  if (part.kind == Kind::Mesh)
  {
    scene::MeshPart mesh =
        *std::find_if(value.meshes.begin(), value.meshes.end(),
                      [&part](const scene::MeshPart& one) { return one.name == part.name; });
    showImage(value, mesh.drawnOn);
    mesh.drawnOn.clear();
    mesh.look.shown = true;
    m_image.meshes = {mesh};
    return;
  }
  const auto holds = [&part](const scene::LabelPart& one)
  {
    return std::any_of(one.structures.begin(), one.structures.end(),
                       [&part](const auto& structure) { return structure.name == part.name; });
  };
  scene::LabelPart map = *std::find_if(value.labels.begin(), value.labels.end(), holds);
  showImage(value, scene::placementOf(value, map).drawnOn);
  map.drawnOn = std::string();
  for (scene::StructurePart& one : map.structures)
    one.look.shown = true;
  m_image.labels = {map};
}

// Nothing but an image: an MR is shown as the primary one.
void AxesDialog::showImage(const scene::Case& value, const std::string& image)
{
  m_image.mr.clear();
  m_image.labels.clear();
  m_image.meshes.clear();
  if (const scene::ImagePart* mr = scene::findMr(value, image))
  {
    m_image.ct = *mr;
    m_image.ct.modality = scene::Modality::Mr;
  }
  m_image.dissection = {}; // its drawings are shown wherever strokes are
}

void AxesDialog::setAxes(const AxesCorrection& axes)
{
  m_axes = axes;
  for (std::size_t axis = 0; axis < m_choices.size(); ++axis)
  {
    const QSignalBlocker blocked(m_choices[axis]);
    m_choices[axis]->setCurrentIndex(m_choices[axis]->findData(QChar(axes.letter(axis))));
  }
  m_apply->setEnabled(!axes.isIdentity());
  m_kind->setText(axes.isIdentity()     ? tr("As it is. Choose what is wrong.")
                  : !axes.isMirroring() ? tr("The anatomy is turned, and not mirrored.")
                  : m_part ? tr("It is mirrored. The image on which it lies stays as it is.")
                           : tr("The anatomy is mirrored: a left ear becomes a right one."));
  scene::Case shown = m_image;
  if (!axes.isIdentity() && !m_part)
    shown = presenters::correctedCase(m_image, axes, m_image.name);
  else if (!axes.isIdentity())
    presenters::correctPart(shown, *m_part, axes);
  const auto presenter = std::make_shared<const presenters::SlicePresenter>(shown);
  for (SliceView* view : m_views)
  {
    view->setPresenter(presenter, shown.ct.geometry);
    view->setCrosshair(middleOf(shown));
  }
}

} // namespace petrous::workstation
