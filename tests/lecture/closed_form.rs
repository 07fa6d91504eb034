//! Arithmetic as text: `4*pi*sind(0.25)^2` → 2.39e-4. Written for the table of the lecture, and for nothing that the library computes with.
//!
//! ```text
//! sum = product (('+' | '-') product)*      product = power (('*' | '/') power)*      power = factor ['^' factor]
//! factor = '-' factor | number | name | name '(' sum ')' | '(' sum ')'
//! ```

struct Text<'t> {
    rest: &'t str,
}

/// The value of an expression.
pub(crate) fn evaluate(text: &str) -> Result<f64, String> {
    let mut text = Text { rest: text };
    let value = text.sum()?;
    if text.next().is_some() { Err(format!("`{}` is left over", text.rest)) } else { Ok(value) }
}

impl Text<'_> {
    fn next(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.next() == Some(wanted);
        if found {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        found
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        let mut value = self.power()?;
        loop {
            if self.take('*') {
                value *= self.power()?;
            } else if self.take('/') {
                value /= self.power()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn power(&mut self) -> Result<f64, String> {
        let base = self.factor()?;
        if self.take('^') { Ok(base.powf(self.factor()?)) } else { Ok(base) }
    }

    fn factor(&mut self) -> Result<f64, String> {
        match self.next() {
            Some('-') => {
                self.take('-');
                Ok(-self.factor()?)
            }
            Some('(') => self.bracket(),
            Some(c) if c.is_ascii_digit() => self.number(),
            Some(c) if c.is_alphabetic() => self.name(),
            _ => Err(format!("a number, a name or a bracket is needed at `{}`", self.rest)),
        }
    }

    fn bracket(&mut self) -> Result<f64, String> {
        if !self.take('(') {
            return Err(format!("a bracket is needed at `{}`", self.rest));
        }
        let value = self.sum()?;
        if self.take(')') { Ok(value) } else { Err(format!("a bracket is open at `{}`", self.rest)) }
    }

    fn number(&mut self) -> Result<f64, String> {
        let mut length = 0;
        let mut before = ' ';
        for c in self.rest.chars() {
            if !(c.is_ascii_digit() || c == '.' || c == 'e' || (c == '-' && before == 'e')) {
                break;
            }
            (length, before) = (length + c.len_utf8(), c);
        }
        let (number, rest) = self.rest.split_at(length);
        self.rest = rest;
        number.parse().map_err(|_| format!("`{number}` is no number"))
    }

    fn name(&mut self) -> Result<f64, String> {
        let length = self.rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(length);
        self.rest = rest;
        let function: fn(f64) -> f64 = match name {
            "pi" => return Ok(std::f64::consts::PI),
            "h" => return Ok(6.626_070_15e-34),
            "c" => return Ok(299_792_458.0),
            "k" => return Ok(1.380_649e-23),
            "NA" => return Ok(6.022_140_76e23),
            "Km" => return Ok(683.002),
            "sin" => f64::sin,
            "atan" => f64::atan,
            "sqrt" => f64::sqrt,
            "exp" => f64::exp,
            "ln" => f64::ln,
            "sind" => |x| x.to_radians().sin(),
            "cosd" => |x| x.to_radians().cos(),
            _ => return Err(format!("`{name}` is no name")),
        };
        Ok(function(self.bracket()?))
    }
}

#[test]
fn arithmetic_is_evaluated_as_it_is_written() {
    for (text, value) in [("1 + 2*3^2", 19.0), ("-(2 - 5)/1.5e1", 0.2), ("2*555e-9^2/1e-18", 616_050.0), ("sqrt(16) - 4*sind(90)", 0.0)] {
        assert!((evaluate(text).unwrap() - value).abs() < 1e-9, "{text}");
    }
    for text in ["1 +", "(1", "2 3", "foo", "sin 3", "1..2"] {
        assert!(evaluate(text).is_err(), "{text}");
    }
}
