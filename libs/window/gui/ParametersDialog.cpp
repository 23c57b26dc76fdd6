#include "window/gui/ParametersDialog.h"

#include <wx/propgrid/props.h>
#include <wx/sizer.h>
#include <wx/stattext.h>

namespace hybrid_slam::window {
namespace {

/// Splits "a | b | c"; empty for other ranges.
wxArrayString choicesOf(const Option& option) {
  wxArrayString choices;
  if (option.range == "true or false") {
    choices.Add("true");
    choices.Add("false");
  }
  if (option.range.find(" | ") == std::string::npos) return choices;
  size_t at = 0;
  while (at != std::string::npos) {
    const size_t end = option.range.find(" | ", at);
    choices.Add(option.range.substr(at, end == std::string::npos ? end : end - at));
    at = end == std::string::npos ? end : end + 3;
  }
  return choices;
}

wxPGProperty* propertyOf(const std::string& section, const Option& option) {
  const wxString label = option.unit.empty() ? option.key : option.key + " (" + option.unit + ")";
  const wxString name = section + "." + option.key;
  const wxArrayString choices = choicesOf(option);
  wxPGProperty* property = nullptr;
  if (choices.empty()) {
    property = new wxStringProperty(label, name, option.get());
  } else {
    property = new wxEnumProperty(label, name, choices, {}, choices.Index(option.get()));
  }
  property->SetHelpString(option.why + " [" + option.range + "]");
  return property;
}

std::string faultOf(Options& options, const std::string& section, const std::string& key,
                    const std::string& value) {
  for (const Option& option : options.table())
    if (option.key == key) {
      const std::string expected = option.set(value);
      return expected.empty() ? ""
                              : "`" + value + "`: section [" + section + "], key `" + key + "`; " + expected;
    }
  return "unknown key: section [" + section + "], key `" + key + "`";
}

}  // namespace

std::string ParametersDialog::fault(const Settings& settings, const std::string& section,
                                    const std::string& key, const std::string& value) {
  const auto trial = settings.copy();
  for (const auto& [name, options] : trial->configuration.sections())
    if (name == section) return faultOf(*options, section, key, value);
  return "unknown section [" + section + "]";
}

ParametersDialog::ParametersDialog(wxWindow* parent, const Settings& settings)
    : wxDialog(parent, wxID_ANY, "Parameters", wxDefaultPosition, parent->FromDIP(wxSize(640, 600)),
               wxDEFAULT_DIALOG_STYLE | wxRESIZE_BORDER),
      settings_(settings.copy()) {
  grid_ = new wxPropertyGrid(this, wxID_ANY, wxDefaultPosition, wxDefaultSize,
                             wxPG_SPLITTER_AUTO_CENTER | wxPG_BOLD_MODIFIED);
  auto* const help = new wxStaticText(this, wxID_ANY, "Values are checked as they are entered.",
                                      wxDefaultPosition, FromDIP(wxSize(-1, 40)), wxST_NO_AUTORESIZE);
  for (const auto& [section, options] : settings_->configuration.sections()) {
    grid_->Append(new wxPropertyCategory("[" + section + "]"));
    for (const Option& option : options->table()) grid_->Append(propertyOf(section, option));
  }
  grid_->Bind(wxEVT_PG_CHANGING, &ParametersDialog::onChanging, this);
  grid_->Bind(wxEVT_PG_CHANGED, &ParametersDialog::onChanged, this);
  grid_->Bind(wxEVT_PG_SELECTED, [help](wxPropertyGridEvent& event) {
    if (!event.GetProperty()) return;
    help->SetLabel(event.GetProperty()->GetHelpString());
    help->Wrap(help->GetClientSize().x);
  });
  auto* const column = new wxBoxSizer(wxVERTICAL);
  column->Add(grid_, wxSizerFlags(1).Expand().Border(wxALL, FromDIP(6)));
  column->Add(help, wxSizerFlags().Expand().Border(wxALL, FromDIP(6)));
  column->Add(CreateStdDialogButtonSizer(wxOK | wxCANCEL), wxSizerFlags().Expand().Border(wxALL, FromDIP(6)));
  SetSizer(column);
}

void ParametersDialog::onChanging(wxPropertyGridEvent& event) {
  const wxPGProperty* const property = event.GetProperty();
  wxVariant entered = event.GetValue();
  const std::string value = property->ValueToString(entered).utf8_string();
  const std::string name = property->GetName().utf8_string();
  const size_t dot = name.find('.');
  const std::string wrong = fault(*settings_, name.substr(0, dot), name.substr(dot + 1), value);
  if (wrong.empty()) return;
  event.SetValidationFailureBehavior(wxPG_VFB_SHOW_MESSAGEBOX | wxPG_VFB_STAY_IN_PROPERTY);
  event.SetValidationFailureMessage(wrong);
  event.Veto();
}

void ParametersDialog::onChanged(wxPropertyGridEvent& event) {
  changes_.push_back(
      (event.GetProperty()->GetName() + "=" + event.GetProperty()->GetValueAsString()).utf8_string());
}

}  // namespace hybrid_slam::window
